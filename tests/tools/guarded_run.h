// A run that steers a vehicle until it comes to an end of some kind, and the vehicle at the other end of its link.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "distributers/links/link.h"
#include "tests/distributers/links/stream_proxy.h"
#include "tests/tools/run_command.h"

namespace jarol::tests {

/// A vehicle that speaks all the time. The run steers it, or sends it `safe`.
class GuardedVehicle : public messages::Receiver {
 public:
  using Clock = std::chrono::steady_clock;

  /// "udp", "udp without peer", "tcp_client", "tcp_server" or "serial": the run's side of the link. A helicopter, else
  /// a submarine. Behind it " with a key": the link has one.
  GuardedVehicle(const std::string& link, bool helicopter);
  ~GuardedVehicle() override;

  bool is_helicopter() const { return helicopter_; }
  /// For the run.
  const std::string& link() const { return link_of_run_; }

  /// Listens and speaks until that is so; false: it was not in time.
  template <class Done>
  bool listen_until(const Done& done, std::chrono::milliseconds patience = std::chrono::seconds(30)) {
    for (const auto end = Clock::now() + patience; Clock::now() < end; pause()) {
      listen();
      if (done()) return true;
    }
    return false;
  }
  void receive(messages::MessageRef message) override;

  bool is_steered() const { return steered_at != Clock::time_point{}; }
  bool is_at_rest() const { return rested_at != Clock::time_point{}; }
  /// Packets that came and were not right: by checksum, sender, or order of their times.
  std::uint64_t flawed() const;

  bool leans = false;                 // as it says
  std::optional<bool> steers_itself;  // as a submarine says; none: it says nothing of that
  Clock::time_point steered_at{};     // when the last command came that was not `safe`
  Clock::time_point rested_at{};      // when all of `safe` had come after it, for the first time
  std::uint64_t packets = 0;          // that came

 private:
  static void pause();
  void listen();
  void hear(std::size_t part, bool is_safe);

  bool helicopter_;
  std::string key_file_;  // or none
  std::string link_of_run_;
  std::unique_ptr<SerialProxy> line_;
  std::unique_ptr<distributers::Link> end_;
  Clock::time_point spoke_at_{};
  std::vector<bool> resting_;  // of all that has to be reported
};

/// The words of a run, on the real clock, of a graph in that folder, which steers the vehicle until it leans: then its
/// task ends the program, in that way of the plugin. Models: "table", "fixed_priority", "threads".
std::string guarded_run(const command::TemporaryFolder& folder, const GuardedVehicle& vehicle, const std::string& model,
                        const std::string& way);

/// The guardian of that process; 0: there is none.
pid_t find_guardian(pid_t of);

}  // namespace jarol::tests
