// The order of tasks that are released together: rows, each of tasks of one group. The same few sets of groups are due
// again and again, so what was merged once is remembered. What finds no room, or its place taken by another set, is
// merged each time.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/plan/plan.h"

namespace jarol {

/// Tasks of one group that run one after the other.
struct Row {
  Indices tasks;
  std::uint32_t due = 0;  // whose they are, of the groups that are due
};

class Rows {
 public:
  /// `remembers`: there is something to merge.
  Rows(const Plan& plan, bool remembers) {
    if (!remembers) return;
    const std::size_t segments = plan.segments.size();
    merged_.reserve(segments);
    if (plan.groups.size() <= max_groups) remembered_.reserve(std::min(places * segments, max_remembered));
  }
  Rows(const Rows&) = delete;  // spans lead into it
  Rows& operator=(const Rows&) = delete;

  /// The rows of the groups that are due, until the next call. `merge(add)` calls add(tasks, due) for each of their
  /// segments in order; it is called where the set is not remembered.
  template <class Merge>
  [[gnu::always_inline]] std::span<const Row> of(std::span<const std::uint32_t> due, Merge merge) {
    std::uint64_t set = 0;
    if (remembered_.capacity() > 0) [[likely]] {
      for (const std::uint32_t group : due) set |= std::uint64_t{1} << group;
      const Remembered& at = place_of(set);
      if (at.set == set) [[likely]]
        return at.rows;
    }
    return make(set, merge);
  }

 private:
  static constexpr std::size_t max_groups = 64, max_remembered = 16'384, places = 64;

  struct Remembered {
    std::uint64_t set = 0;  // a bit for each group
    std::span<const Row> rows;
  };

  Remembered& place_of(std::uint64_t set) {
    return place_[(set * 0x9e3779b97f4a7c15u) >> (64 - std::countr_zero(places))];
  }

  template <class Merge>
  [[gnu::noinline]] std::span<const Row> make(std::uint64_t set, Merge merge) {
    merged_.clear();
    merge([&](const Indices& tasks, std::uint32_t due) {
      if (!merged_.empty() && merged_.back().due == due && merged_.back().tasks.last() == tasks.first)
        merged_.back().tasks.count += tasks.count;
      else
        merged_.push_back({tasks, due});
    });
    if (place_of(set).set != 0 || remembered_.size() + merged_.size() > remembered_.capacity()) return merged_;
    const std::size_t first = remembered_.size();
    remembered_.insert(remembered_.end(), merged_.begin(), merged_.end());
    place_of(set) = {set, {remembered_.data() + first, merged_.size()}};
    return place_of(set).rows;
  }

  std::vector<Row> merged_;      // room for all segments
  std::vector<Row> remembered_;  // never moves
  std::array<Remembered, places> place_{};
};

}  // namespace jarol
