#include "graph/analysis/sensitivity.h"

#include <algorithm>
#include <cmath>

namespace jarol::analysis {
namespace {

bool holds(const System& system, Effort& effort) { return verdict_of(system, effort) == Verdict::schedulable; }

// The largest x in [low, high) with good(x), where good is monotone and good(low).
template <class Good>
std::int64_t largest(std::int64_t low, std::int64_t high, const Good& good) {
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (good(middle) ? low : high) = middle;
  }
  return low;
}

System scaled(const System& system, std::int64_t millionths) {
  System changed = system;
  for (Load& l : changed.loads)
    l.wcet = static_cast<std::int64_t>((static_cast<Wide>(l.wcet - l.overhead) * millionths + 999'999) / 1'000'000) +
             l.overhead;
  return changed;
}

std::optional<std::int64_t> most_wcet(const System& system, std::size_t task, Effort& effort) {
  System changed = system;
  const auto good = [&](std::int64_t wcet) {
    changed.loads[task].wcet = wcet;
    return holds(changed, effort);
  };
  const std::int64_t overhead = system.loads[task].overhead;
  if (!good(1 + overhead)) return std::nullopt;
  return largest(1 + overhead, system.loads[task].deadline + overhead + 1, good) - overhead;
}

std::optional<std::int64_t> least_deadline(const System& system, std::size_t task, Effort& effort) {
  System changed = system;
  // negated: the search looks for the largest
  const auto good = [&](std::int64_t negative) {
    changed.loads[task].deadline = -negative;
    return holds(changed, effort);
  };
  const std::int64_t now = system.loads[task].deadline;
  if (!good(-now)) return std::nullopt;
  return -largest(-now, 0, good);
}

}  // namespace

std::optional<Sensitivity> sensitivity_of(const System& system, bool per_task, Effort& effort) {
  Sensitivity result;
  result.most_wcet.resize(system.loads.size());
  result.least_deadline.resize(system.loads.size());
  const bool any = std::any_of(system.loads.begin(), system.loads.end(), [](const Load& l) { return l.wcet > 0; });
  if (any && holds(scaled(system, 1), effort)) {
    std::int64_t high = 1'000'000;
    while (high < 1'000'000'000'000 && holds(scaled(system, high), effort)) high *= 2;
    const std::int64_t factor = largest(high == 1'000'000 ? 1 : high / 2, high,
                                        [&](std::int64_t f) { return holds(scaled(system, f), effort); });
    result.alpha = static_cast<double>(factor) * 1e-6;
  }
  if (effort.spent()) return std::nullopt;
  if (!per_task) return result;
  double least = 0;
  for (std::size_t i = 0; i < system.loads.size(); ++i) {
    result.most_wcet[i] = most_wcet(system, i, effort);
    result.least_deadline[i] = least_deadline(system, i, effort);
    if (!result.most_wcet[i] || system.loads[i].wcet == system.loads[i].overhead) continue;
    const double room = static_cast<double>(*result.most_wcet[i]) /
                        static_cast<double>(system.loads[i].wcet - system.loads[i].overhead);
    if (result.binding && room >= least) continue;
    least = room;
    result.binding = i;
  }
  if (effort.spent()) return std::nullopt;  // the last ones were given up
  return result;
}

std::vector<WcetCut> wcet_cuts(const System& system, Effort& effort) {
  if (system.loads.size() > 100) return {};
  std::vector<std::pair<double, WcetCut>> cuts;
  for (std::size_t i = 0; i < system.loads.size(); ++i) {
    const std::int64_t now = system.loads[i].wcet - system.loads[i].overhead;
    const auto wcet = most_wcet(system, i, effort);
    if (!wcet || effort.spent() || *wcet >= now) continue;
    cuts.push_back({1 - static_cast<double>(*wcet) / static_cast<double>(now), {i, *wcet}});
  }
  std::stable_sort(cuts.begin(), cuts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<WcetCut> sorted;
  for (const auto& [cut, of_task] : cuts) sorted.push_back(of_task);
  return sorted;
}

}  // namespace jarol::analysis
