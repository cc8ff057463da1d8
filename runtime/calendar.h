// When each group of a plan is due next: the next instant and the groups due at it, without a table over the
// hyperperiod.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace jarol {

class Calendar {
 public:
  /// Adds a group, numbered in the order of adding: due at `first`, `first + period`, ... (ns).
  void add(std::int64_t first, std::int64_t period) {
    times_.push_back({first, period});
    least_ = std::min(least_, first);
    heap_.push_back(static_cast<std::uint32_t>(heap_.size()));
    std::push_heap(heap_.begin(), heap_.end(), Later{times_});
  }

  /// The next instant at which any group is due; the greatest integer if there is no group.
  std::int64_t next() const { return least_; }

  /// The groups due at next(), least number first; next() then is the instant after it.
  void take(std::vector<std::uint32_t>& due) {
    due.clear();
    times_.size() <= few ? take_by_scan(due) : take_by_heap(due);
  }

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

  void take_by_scan(std::vector<std::uint32_t>& due) {
    const std::int64_t now = least_;
    least_ = std::numeric_limits<std::int64_t>::max();
    for (std::uint32_t group = 0; group < times_.size(); ++group) {
      Time& time = times_[group];
      if (time.next == now) {
        due.push_back(group);
        time.advance();
      }
      least_ = std::min(least_, time.next);
    }
  }

  void take_by_heap(std::vector<std::uint32_t>& due) {
    const std::int64_t now = least_;
    while (times_[heap_.front()].next == now) {
      const std::uint32_t group = heap_.front();
      due.push_back(group);
      std::pop_heap(heap_.begin(), heap_.end(), Later{times_});
      times_[group].advance();
      std::push_heap(heap_.begin(), heap_.end(), Later{times_});
    }
    least_ = times_[heap_.front()].next;
  }

  std::vector<Time> times_;          // per group
  std::vector<std::uint32_t> heap_;  // of groups
  std::int64_t least_ = std::numeric_limits<std::int64_t>::max();
};

}  // namespace jarol
