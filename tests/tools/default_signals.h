// Signals that end a program end those that are made while this lives, also where the tests run under nohup or in the
// background of a shell that ignores them.
#pragma once

#include <array>
#include <csignal>

namespace command {

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
