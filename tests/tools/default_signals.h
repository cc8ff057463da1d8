// Signals that end a program, as tests send them.
#pragma once

#include <array>
#include <csignal>
#include <string>

namespace command {

/// Waits, in a shell, until process $id takes the signals HUP, INT and TERM, or is gone.
inline const std::string until_taken =
    "until grep -Eq '^SigCgt:.*[4-7c-f]..[37bf]$|^State:.Z' /proc/$id/status; do sleep 0.01; done; ";

/// They end the programs that are started while this lives, also where the tests run under nohup or in the background
/// of a shell that ignores them.
class DefaultSignals {
 public:
  DefaultSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i) before_[i] = std::signal(signals[i], SIG_DFL);
  }
  ~DefaultSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], before_[i]);
  }
  DefaultSignals(const DefaultSignals&) = delete;
  DefaultSignals& operator=(const DefaultSignals&) = delete;

 private:
  static constexpr std::array signals{SIGINT, SIGQUIT, SIGTERM, SIGHUP};
  std::array<void (*)(int), signals.size()> before_{};
};

}  // namespace command
