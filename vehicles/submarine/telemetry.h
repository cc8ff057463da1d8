// What DUNE reports to a console about a simulated submarine, and how often.
#pragma once

#include <array>
#include <cstdint>

#include "distributers/interfaces/vehicle.h"
#include "distributers/messages/imc.h"

namespace jarol::vehicles {

/// Passes on what the submarine reports, at the rates of DUNE's simulator. It
/// adds, from the true state, 20 EstimatedState, 5 GroundVelocity, an EstimatedStreamVelocity and a Heartbeat a second.
/// Readings of instruments that DUNE reads at other rates go out at those, the newest each time, until their sensor is
/// overdue. Leak sensors and thermometers of the hull, entities each, and Voltage and Current, which DUNE's simulator
/// has not, come as they report.
class SubmarineTelemetry : public messages::Receiver {
 public:
  explicit SubmarineTelemetry(messages::Receiver& to);

  void receive(messages::MessageRef message) override;

 private:
  struct Reading {
    const messages::MessageDescriptor* descriptor = nullptr;
    std::int64_t rate = 0;  // 1/s, of DUNE
    messages::Message newest{};
    std::int64_t at = 0, interval = 0;  // in states: when it came, and the one before that
  };

  bool keep(messages::MessageRef message);
  void report_readings();
  void report_estimate(const messages::imc::SimulatedState& truth);
  void report_water(const messages::imc::SimulatedState& truth);
  bool is_due(std::int64_t rate) const;

  messages::Receiver& to_;
  std::int64_t states_ = 0;  // so far
  std::array<Reading, 7> readings_;
};

/// DUNE's Announce of a simulated submarine, which can be reached at an address, as in "udp://127.0.0.1:6002", and lies
/// where it is.
messages::Message announcement_of(const Vehicle& vehicle, const std::string& address);

}  // namespace jarol::vehicles
