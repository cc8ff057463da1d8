// Ctrl-C, as commands that run for long take it: they end cleanly. And what may not end them at all.
#pragma once

#include <array>
#include <atomic>
#include <csignal>
#include <functional>

#include "runtime/execute/attend.h"

namespace jarol::tools {

/// What Ctrl-Z does, SIGTSTP: halt the process as ever, or end the run as the other signals do, where something steers
/// that must not be left alone.
enum class HaltKey { halts, ends };

/// What a second signal does: end the program, or ask for haste where the first one begins what takes its time; then a
/// third one ends the program.
enum class SecondSignal { ends, hastens };

/// While it lives, the first of SIGINT, SIGTERM and SIGHUP sets a flag, and calls what has to be called at once; there
/// is one at a time. From then on to the end of the program another one ends it on the spot, but only half a second
/// after the one before: Ctrl-C pressed twice, or a terminal that sends two signals, does not lose the report.
class Interruptible {
 public:
  /// `at_once` is called by the signal handler: it may do no more than set atomic variables.
  explicit Interruptible(
      std::function<void()> at_once = [] {}, HaltKey halt_key = HaltKey::halts,
      SecondSignal second_signal = SecondSignal::ends);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  static const std::atomic<bool>& interrupted();
  /// The first signal, or 0.
  static int signal();
  static Wish wish();
  /// From now on there is nothing left to hasten: a second signal ends the program.
  static void forbid_haste();
  /// Prints what nobody may be reading: a second after a first signal, whether it has come or comes meanwhile, the
  /// program ends.
  static void report(const std::function<void()>& print);

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP, SIGTSTP};
  std::array<void (*)(int), signals.size()> before_{};
  std::size_t count_;  // of the signals that are taken
};

/// From now on a pipe that nobody reads, and a file beyond the limit of its size, are errors of writing as any other:
/// they end no program that steers a vehicle.
void let_writing_fail();

}  // namespace jarol::tools
