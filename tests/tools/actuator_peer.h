// The other end of a vehicle's link, for tests: it speaks now and then, and notes each thrust that it is commanded.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace jarol::tests {

using PeerClock = std::chrono::steady_clock;

struct Thrust {
  PeerClock::time_point at;
  double value = 0;
};

class ActuatorPeer {
 public:
  virtual ~ActuatorPeer() = default;

  /// The link to it as a graph has it.
  virtual std::string link() const = 0;
  /// What came until now.
  virtual std::vector<Thrust> thrusts() const = 0;
  /// It is gone.
  virtual void vanish() = 0;

  /// It was commanded that thrust.
  bool has(double thrust) const;
};

/// `kind`: udp, tcp_client, tcp_server, serial or lockstep, as the graph calls its own end.
std::unique_ptr<ActuatorPeer> make_actuator_peer(const std::string& kind);

}  // namespace jarol::tests
