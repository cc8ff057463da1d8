// The time trigger: a periodic signal on absolute time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "runtime/jarol/signal.h"
#include "runtime/machine/futex.h"

namespace jarol {

/// Ticks at first, first + period, ... for all who wait then. Each who waits sleeps until the tick himself: one
/// wake-up, where a thread that ticks and signals would take two. Ticks that nobody awaits are counted.
template <class Threads>
class BasicTimeTrigger {
 public:
  using Time = typename Threads::Time;
  using Span = decltype(Time{} - Time{});

  /// The period is above zero.
  BasicTimeTrigger(Span period, Time first) : period_(period), first_(first) {}
  BasicTimeTrigger(const BasicTimeTrigger&) = delete;
  BasicTimeTrigger& operator=(const BasicTimeTrigger&) = delete;

  Span period() const { return period_; }

  /// When the tick of that number is; the first one is 0.
  Time time_of(std::int64_t tick) const { return first_ + tick * period_; }

  /// Ticks up to now.
  std::int64_t ticks() const { return ticks_until(Threads::now()); }

  /// Waits for the next tick, the deadline, or the end: `signalled`, `timed_out`, `interrupted`. Any number of threads.
  Awaiting await(std::optional<Time> deadline = {}) {
    std::int64_t next = 0;
    do {
      if (stopped_.load(std::memory_order_acquire) != 0) return stopped;
      next = ticks();
      if (deadline && *deadline < time_of(next)) return sleep_until(*deadline) ? Awaiting::timed_out : stopped;
    } while (!claim(next));
    return sleep_until(time_of(next)) ? Awaiting::signalled : stopped;
  }

  /// No more ticks: who waits is woken, who comes is turned away, both with `interrupted`.
  void stop() {
    if (stopped_.fetch_or(1, std::memory_order_acq_rel) != 0) return;
    pass(ticks());
    Threads::wake_all(stopped_);
  }

  /// Ticks up to now that nobody awaited.
  std::int64_t unawaited() const {
    const std::int64_t live = stopped_.load(std::memory_order_acquire) != 0 ? 0 : ticks();
    const std::int64_t reported = reported_.load(std::memory_order_acquire);
    return unawaited_.load(std::memory_order_acquire) + std::max<std::int64_t>(0, live - reported);
  }

 private:
  static constexpr Awaiting stopped = Awaiting::interrupted;

  // Ticks that have passed at this time; the number of the next one.
  std::int64_t ticks_until(Time time) const { return time < first_ ? 0 : (time - first_) / period_ + 1; }

  // False once the trigger is stopped.
  bool sleep_until(Time time) {
    while (stopped_.load(std::memory_order_acquire) == 0)
      if (!Threads::wait(stopped_, 0, time)) return true;
    return false;
  }

  // The tick is awaited, and those before it of which nobody has reported were not. False: it has passed meanwhile.
  bool claim(std::int64_t tick) {
    std::int64_t reported = reported_.load(std::memory_order_acquire);
    while (reported <= tick)
      if (reported_.compare_exchange_weak(reported, tick + 1, std::memory_order_acq_rel, std::memory_order_acquire)) {
        unawaited_.fetch_add(tick - reported, std::memory_order_acq_rel);
        return true;
      }
    return reported == tick + 1;
  }

  void pass(std::int64_t ticks) {
    std::int64_t reported = reported_.load(std::memory_order_acquire);
    while (reported < ticks)
      if (reported_.compare_exchange_weak(reported, ticks, std::memory_order_acq_rel, std::memory_order_acquire)) {
        unawaited_.fetch_add(ticks - reported, std::memory_order_acq_rel);
        return;
      }
  }

  Span period_;
  Time first_;
  typename Threads::template Atomic<std::uint32_t> stopped_{0};
  typename Threads::template Atomic<std::int64_t> reported_{0};  // ticks that were awaited or counted
  typename Threads::template Atomic<std::int64_t> unawaited_{0};
};

extern template class BasicTimeTrigger<Futex>;

class TimeTrigger : public BasicTimeTrigger<Futex> {
 public:
  /// Throws std::invalid_argument for a period that is not above zero. The first tick is a period from now.
  explicit TimeTrigger(std::chrono::nanoseconds period);
  TimeTrigger(std::chrono::nanoseconds period, Time first);
};

}  // namespace jarol
