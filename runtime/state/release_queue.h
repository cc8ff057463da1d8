// When each group of a plan is due next: the next instant and the groups due at it. Few groups whose pattern soon
// repeats get a timetable of bounded size, other few are scanned, and many have a calendar: cost and memory do not
// depend on the hyperperiod.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "graph/language/duration.h"
#include "runtime/state/calendar_queue.h"
#include "runtime/state/timetable.h"

namespace jarol {

class ReleaseQueue {
 public:
  /// As before the first group was added.
  void clear() {
    times_.clear();
    due_.clear();
    many_ = CalendarQueue();
    timetable_.clear();
    tried_ = false;
    next_ = CalendarQueue::never;
  }

  void reserve(std::size_t groups) {
    due_.reserve(few);
    times_.reserve(few);
    if (groups > few) return many_.reserve(groups);
    begins_.reserve(few);
    timetable_.reserve();
  }

  /// Before the first take. Adds a group, numbered in the order of adding: due at `first`, `first + period`, ...
  void add(Duration first, Duration period) {
    assert(!tried_);
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

  /// The next instant at which any group is due; the greatest there is if there is no group.
  Duration next() const { return next_; }

  /// The groups due at next(), least number first, until the next call; next() then is the instant after it.
  std::span<const std::uint32_t> take() {
    if (!timetable_.empty()) [[likely]]
      return take_by_timetable();
    if (many_.empty()) {
      if (!tried_) make_timetable();
      return timetable_.empty() ? take_by_scan() : take_by_timetable();
    }
    const std::span<const std::uint32_t> due = many_.take();
    next_ = many_.next();
    return due;
  }

 private:
  // up to here a look at all is faster
  static constexpr std::size_t few = 32;

  struct Time {
    Duration next;
    Duration period;
  };

  std::span<const std::uint32_t> take_by_timetable() {
    Duration to_next{};
    const auto due = timetable_.take(to_next);
    next_ = CalendarQueue::later(next_, to_next);
    return due;
  }

  // Once each group is due within a period of its own: the pattern repeats from there on, so that a timetable ends.
  [[gnu::noinline]] void make_timetable() {
    for (const Time& time : times_)
      if (time.next - next_ >= time.period) return;
    tried_ = true;
    const Duration begin = next_;
    begins_ = times_;
    const auto repeats = [&] {
      for (std::size_t i = 0; i < times_.size(); ++i)
        if (times_[i].next - next_ != begins_[i].next - begin) return false;
      return true;
    };
    do {
      const Duration now = next_;
      const auto due = take_by_scan();
      if (!timetable_.add(next_ - now, due)) break;
    } while (!repeats());
    times_ = begins_;
    next_ = begin;
  }

  // without branches on what is due, which no processor could predict
  std::span<const std::uint32_t> take_by_scan() {
    constexpr auto never = static_cast<std::uint64_t>(CalendarQueue::never.count());
    const Duration now = next_;
    Duration min = CalendarQueue::never;
    std::size_t count = 0;
    const auto groups = static_cast<std::uint32_t>(times_.size());
    for (std::uint32_t group = 0; group < groups; ++group) {
      Time& time = times_[group];
      const bool is_due = time.next == now;
      due_[count] = group;
      count += is_due ? 1 : 0;
      // an instant beyond what 64 bits hold, 292 years, is never reached
      const auto later = static_cast<std::uint64_t>(time.next.count()) +
                         (is_due ? static_cast<std::uint64_t>(time.period.count()) : 0);
      time.next = Duration(static_cast<std::int64_t>(std::min(later, never)));
      min = std::min(min, time.next);
    }
    next_ = min;
    return {due_.data(), count};
  }

  std::vector<Time> times_;         // of few groups
  std::vector<Time> begins_;        // the same where their timetable begins
  std::vector<std::uint32_t> due_;  // room for them
  Timetable timetable_;             // of few whose pattern soon repeats
  bool tried_ = false;              // it was made, or there is no room for it
  CalendarQueue many_;              // of more: all
  Duration next_ = CalendarQueue::never;
};

}  // namespace jarol
