// Waiting for a change of a word, and waking those who wait, by the kernel.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

namespace jarol {

/// The monotonic clock of the machine (CLOCK_MONOTONIC).
using MachineClock = std::chrono::steady_clock;

struct Futex {
  template <class T>
  using Atomic = std::atomic<T>;
  using Time = MachineClock::time_point;

  static Time now() { return MachineClock::now(); }

  /// Sleeps while the word is `old`; false once the deadline has passed. May return true without a reason.
  static bool wait(std::atomic<std::uint32_t>& word, std::uint32_t old, std::optional<Time> deadline);
  static void wake_all(std::atomic<std::uint32_t>& word);
};

}  // namespace jarol
