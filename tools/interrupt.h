// Ctrl-C, as commands that run for long take it: they end cleanly.
#pragma once

#include <atomic>
#include <functional>

namespace jarol::tools {

/// While it lives, SIGINT and SIGTERM set a flag, and call what has to be called at once; there is one at a time.
class Interruptible {
 public:
  /// `at_once` is called by the signal handler: it may do no more than set atomic variables.
  explicit Interruptible(std::function<void()> at_once = [] {});
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  static const std::atomic<bool>& interrupted();

 private:
  void (*before_int_)(int);
  void (*before_term_)(int);
};

}  // namespace jarol::tools
