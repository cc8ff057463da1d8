// Tasks as the analysis of one core sees them.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "graph/language/duration.h"

namespace jarol::analysis {

__extension__ using Wide = __int128;

/// No instant is beyond it.
inline constexpr Duration max_time{std::int64_t{1} << 60};

struct TaskModel {
  Duration wcet{};
  Duration period{1};
  Duration deadline{1};  // relative to the arrival
  Duration offset{};
  Duration jitter{};    // the release follows the arrival by at most so much
  Duration blocking{};  // by what can't be preempted, once an activation
  Duration overhead{};  // the part of the WCET that is the platform's
};

/// A sum of times in ns as one time: the longest that there is, where it is longer than that.
inline Duration saturated(Wide sum) {
  return Duration(static_cast<std::int64_t>(std::min<Wide>(sum, Duration::max().count())));
}

/// Of one core; most urgent first where priorities count.
using TaskModels = std::vector<TaskModel>;

/// Sum of wcet / period against `bound` without rounding; nothing if the common denominator is out of reach and the two
/// are as close as rounding goes.
std::optional<std::strong_ordering> compare_utilisation(std::span<const TaskModel> models, std::int64_t bound);

double utilisation(std::span<const TaskModel> models);

/// Least common multiple of the periods, or nothing beyond `max`.
std::optional<Duration> hyperperiod(std::span<const TaskModel> models, Duration max);

/// How much work may still go into an answer, in steps of some nanoseconds, so that one is given up after the same work
/// on every machine. Unlimited unless stated.
struct Budget {
  std::uint64_t left = std::numeric_limits<std::uint64_t>::max();

  /// False once there is no more.
  bool spend(std::uint64_t steps) {
    left -= std::min(left, steps);
    return left > 0;
  }
  bool spent() const { return left == 0; }
};

/// Does what `test` does with a limit of its own, within that of all.
template <class Test>
auto within(Budget& budget, std::uint64_t max, const Test& test) {
  Budget own{std::min(budget.left, max)};
  const std::uint64_t before = own.left;
  auto result = test(own);
  budget.spend(before - own.left);
  return result;
}

inline Wide ceil_div(Wide a, Wide b) { return (a + b - 1) / b; }

}  // namespace jarol::analysis
