// When each group of a plan is due next: the next instant and the groups due at it, without a table over the
// hyperperiod.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "graph/language/duration.h"
#include "runtime/state/calendar_queue.h"

namespace jarol {

class ReleaseQueue {
 public:
  /// As before the first group was added.
  void clear() {
    times_.clear();
    due_.clear();
    many_ = CalendarQueue();
    next_ = CalendarQueue::never;
  }

  void reserve(std::size_t groups) {
    due_.reserve(few);
    times_.reserve(few);
    if (groups > few) many_.reserve(groups);
  }

  /// Adds a group, numbered in the order of adding: due at `first`, `first + period`, ...
  void add(Duration first, Duration period) { add(first.count(), period.count()); }

  /// The next instant at which any group is due; the greatest there is if there is no group.
  Duration next() const { return Duration(next_); }

  /// The groups due at next(), least number first, until the next call; next() then is the instant after it.
  std::span<const std::uint32_t> take() {
    if (many_.empty()) return take_by_scan();
    const std::span<const std::uint32_t> due = many_.take();
    next_ = many_.next();
    return due;
  }

 private:
  // up to here a look at all is faster
  static constexpr std::size_t few = 32;

  // in ns from here on
  void add(std::int64_t first, std::int64_t period) {
    next_ = std::min(next_, first);
    if (many_.empty() && times_.size() < few) {
      due_.push_back(0);
      times_.push_back({first, period});
      return;
    }
    if (many_.empty())
      for (const Time& time : times_) many_.add(time.next, time.period);
    many_.add(first, period);
  }

  struct Time {
    std::int64_t next;
    std::int64_t period;
  };

  // without branches on what is due, which no processor could predict
  std::span<const std::uint32_t> take_by_scan() {
    constexpr auto never = static_cast<std::uint64_t>(CalendarQueue::never);
    const std::int64_t now = next_;
    std::int64_t min = CalendarQueue::never;
    std::size_t count = 0;
    const auto groups = static_cast<std::uint32_t>(times_.size());
    for (std::uint32_t group = 0; group < groups; ++group) {
      Time& time = times_[group];
      const bool is_due = time.next == now;
      due_[count] = group;
      count += is_due ? 1 : 0;
      // an instant beyond what 64 bits hold, 292 years, is never reached
      const auto later = static_cast<std::uint64_t>(time.next) + (is_due ? static_cast<std::uint64_t>(time.period) : 0);
      time.next = static_cast<std::int64_t>(std::min(later, never));
      min = std::min(min, time.next);
    }
    next_ = min;
    return {due_.data(), count};
  }

  std::vector<Time> times_;         // of few groups
  std::vector<std::uint32_t> due_;  // room for them
  CalendarQueue many_;              // of more: all
  std::int64_t next_ = CalendarQueue::never;
};

}  // namespace jarol
