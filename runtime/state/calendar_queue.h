// When each of many groups is due next: a calendar queue (R. Brown, "Calendar queues: a fast O(1) priority queue
// implementation for the simulation event set problem", CACM 31(10), 1988). A ring of days, each about as long as it
// takes until one more group is due; a group stands in the list of the day on which it is due, whatever the year. So
// what comes next is found in the list of today or of the next few days, however many groups there are.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "graph/language/duration.h"
#include "runtime/machine/large_pages.h"

namespace jarol {

class CalendarQueue {
 public:
  static constexpr Duration never = Duration::max();

  /// An instant beyond what 64 bits hold, 292 years, is never reached.
  static Duration later(Duration instant, Duration by) {
    std::int64_t sum = 0;
    return __builtin_add_overflow(instant.count(), by.count(), &sum) ? never : Duration(sum);
  }

  void reserve(std::size_t groups) {
    groups_.reserve(groups);
    due_.reserve(groups);
    days_.reserve(days_for(groups));
  }

  /// Before the first take. Numbered in the order of adding: due at `first`, `first + period`, ...
  void add(Duration first, Duration period) {
    groups_.push_back({first, period, none});
    due_.push_back(0);
    next_ = std::min(next_, first);
  }

  bool empty() const { return groups_.empty(); }

  /// The next instant at which any group is due, or never.
  Duration next() const { return next_; }

  /// The groups due at next(), least number first, until the next call; next() then is the instant after it.
  std::span<const std::uint32_t> take() {
    if (days_.empty()) make_days();
    const std::size_t count = take_out(next_);
    std::sort(due_.begin(), due_.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i < count; ++i) {
      Group& group = groups_[due_[i]];
      group.next = later(group.next, group.period);
      put_in(due_[i]);
    }
    next_ = find_from(next_);
    return {due_.data(), count};
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  struct Group {
    Duration next;
    Duration period;
    std::uint32_t link;  // the next in the list of its day
  };

  static std::size_t days_for(std::size_t groups) { return std::bit_ceil(2 * groups); }

  std::int64_t day_of(Duration instant) const { return instant.count() >> shift_; }

  std::uint32_t& list_of(std::int64_t day) { return days_[static_cast<std::size_t>(day) & (days_.size() - 1)]; }

  void put_in(std::uint32_t number) {
    std::uint32_t& list = list_of(day_of(groups_[number].next));
    groups_[number].link = list;
    list = number;
  }

  // How many are due then; they are in due_ now, and in no list.
  std::size_t take_out(Duration instant) {
    std::size_t count = 0;
    for (std::uint32_t* at = &list_of(day_of(instant)); *at != none;) {
      Group& group = groups_[*at];
      if (group.next == instant) {
        due_[count++] = *at;
        *at = group.link;
      } else {
        at = &group.link;
      }
    }
    return count;
  }

  void make_days() {
    double per_ns = 0;
    for (const Group& group : groups_) per_ns += 1 / static_cast<double>(group.period.count());
    shift_ = per_ns >= 1 ? 0 : std::bit_width(static_cast<std::uint64_t>(1 / per_ns)) - 1;
    days_.assign(days_for(groups_.size()), none);
    for (std::uint32_t number = 0; number < groups_.size(); ++number) put_in(number);
  }

  // The earliest of all, none of which lies before that instant.
  Duration find_from(Duration instant) {
    std::int64_t day = day_of(instant);
    for (std::size_t looked_at = 0; looked_at < days_.size(); ++looked_at, ++day) {
      Duration min = never;  // of other years, too
      for (std::uint32_t number = list_of(day); number != none; number = groups_[number].link)
        min = std::min(min, groups_[number].next);
      if (day_of(min) == day) return min;
    }
    // nothing for a whole year
    Duration min = never;
    for (const Group& group : groups_) min = std::min(min, group.next);
    return min;
  }

  LargeVector<Group> groups_;
  LargeVector<std::uint32_t> days_;  // the first of each list; a power of two of them
  std::vector<std::uint32_t> due_;   // room for all groups
  int shift_ = 0;                    // a day is 2^shift ns
  Duration next_ = never;
};

}  // namespace jarol
