// Ctrl-C, as commands that run for long take it: they end cleanly.
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <functional>

namespace jarol::tools {

/// While it lives, the first of SIGINT, SIGTERM and SIGHUP sets a flag, and calls what has to be called at once; there
/// is one at a time. From then on to the end of the program another one ends it on the spot, but only half a second
/// after the first: Ctrl-C pressed twice, or a terminal that sends two signals, does not lose the report.
class Interruptible {
 public:
  /// `at_once` is called by the signal handler: it may do no more than set atomic variables.
  explicit Interruptible(std::function<void()> at_once = [] {});
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  static const std::atomic<bool>& interrupted();

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
  std::array<void (*)(int), signals.size()> before_{};
};

}  // namespace jarol::tools
