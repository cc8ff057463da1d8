// When each group of a plan is due next: the next instant and the groups due at it, without a table over the
// hyperperiod.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace jarol {

class Calendar {
 public:
  void reserve(std::size_t groups) {
    due_.reserve(groups);
    times_.reserve(groups);
    heap_.reserve(groups);
  }

  /// Adds a group, numbered in the order of adding: due at `first`, `first + period`, ... (ns).
  void add(std::int64_t first, std::int64_t period) {
    due_.push_back(0);
    times_.push_back({first, period});
    least_ = std::min(least_, first);
    heap_.push_back(static_cast<std::uint32_t>(heap_.size()));
    std::push_heap(heap_.begin(), heap_.end(), Later{times_});
  }

  /// The next instant at which any group is due; the greatest integer if there is no group.
  std::int64_t next() const { return least_; }

  /// The groups due at next(), least number first, until the next call; next() then is the instant after it.
  std::span<const std::uint32_t> take() { return times_.size() <= few ? take_by_scan() : take_by_heap(); }

 private:
  // up to here a look at all is faster than a heap
  static constexpr std::size_t few = 32;

  struct Time {
    std::int64_t next;
    std::int64_t period;
    // an instant beyond what 64 bits hold, 292 years, is never reached
    void advance() {
      if (__builtin_add_overflow(next, period, &next)) next = std::numeric_limits<std::int64_t>::max();
    }
  };

  struct Later {
    const std::vector<Time>& times;
    bool operator()(std::uint32_t a, std::uint32_t b) const {
      return times[a].next != times[b].next ? times[a].next > times[b].next : a > b;
    }
  };

  // without branches on what is due, which no processor could predict
  std::span<const std::uint32_t> take_by_scan() {
    const std::int64_t now = least_;
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    std::size_t count = 0;
    const auto groups = static_cast<std::uint32_t>(times_.size());
    for (std::uint32_t group = 0; group < groups; ++group) {
      Time& time = times_[group];
      const bool is_due = time.next == now;
      due_[count] = group;
      count += is_due ? 1 : 0;
      const auto later = static_cast<std::uint64_t>(time.next) + (is_due ? static_cast<std::uint64_t>(time.period) : 0);
      time.next = later > greatest ? static_cast<std::int64_t>(greatest) : static_cast<std::int64_t>(later);
      least = std::min(least, time.next);
    }
    least_ = least;
    return {due_.data(), count};
  }

  std::span<const std::uint32_t> take_by_heap() {
    const std::int64_t now = least_;
    std::size_t count = 0;
    while (times_[heap_.front()].next == now) {
      const std::uint32_t group = heap_.front();
      due_[count++] = group;
      std::pop_heap(heap_.begin(), heap_.end(), Later{times_});
      times_[group].advance();
      std::push_heap(heap_.begin(), heap_.end(), Later{times_});
    }
    least_ = times_[heap_.front()].next;
    return {due_.data(), count};
  }

  static constexpr auto greatest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());

  std::vector<Time> times_;          // per group
  std::vector<std::uint32_t> heap_;  // of groups
  std::vector<std::uint32_t> due_;   // room for all groups
  std::int64_t least_ = std::numeric_limits<std::int64_t>::max();
};

}  // namespace jarol
