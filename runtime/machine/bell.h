// Between a thread that has work for another and that one, where calls of the system are to be few: who waits looks
// again by itself, soon at first and then less often, and is woken only for what can't wait so long.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>

#include "runtime/machine/futex.h"

namespace jarol {

class Bell {
 public:
  /// Whoever sleeps is woken.
  void ring() {
    rings_.fetch_add(1, std::memory_order_release);
    Futex::wake_all(rings_);
  }
  /// The same without a call of the system where nobody sleeps.
  void ring_if_asleep() {
    if (is_asleep_.load(std::memory_order_relaxed)) ring();
  }

  /// By the one thread that waits, before it looks for work.
  std::uint32_t rings() const { return rings_.load(std::memory_order_acquire); }
  /// It has found none: sleeps until the bell has been rung since `rings`, or for a while.
  void sleep(std::uint32_t rings) {
    is_asleep_.store(true, std::memory_order_relaxed);
    Futex::wait(rings_, rings, Futex::now() + pause_);
    is_asleep_.store(false, std::memory_order_relaxed);
    pause_ = std::min(2 * pause_, longest);
  }
  /// It has found some.
  void stay_awake() { pause_ = shortest; }

  static constexpr std::chrono::microseconds shortest{50}, longest{1000};

 private:
  std::atomic<std::uint32_t> rings_{0};
  std::atomic<bool> is_asleep_{false};
  std::chrono::microseconds pause_ = shortest;
};

}  // namespace jarol
