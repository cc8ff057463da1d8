#include "graph/analysis/sensitivity.h"

#include <algorithm>
#include <cmath>

namespace jarol::analysis {
namespace {

bool holds(const System& system, Budget& budget) { return verdict_of(system, budget) == Verdict::schedulable; }

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
  for (TaskModel& m : changed.models)
    m.wcet = static_cast<std::int64_t>((static_cast<Wide>(m.wcet - m.overhead) * millionths + 999'999) / 1'000'000) +
             m.overhead;
  return changed;
}

std::optional<std::int64_t> max_wcet(const System& system, std::size_t task, Budget& budget) {
  System changed = system;
  const auto good = [&](std::int64_t wcet) {
    changed.models[task].wcet = wcet;
    return holds(changed, budget);
  };
  const std::int64_t overhead = system.models[task].overhead;
  if (!good(1 + overhead)) return std::nullopt;
  return largest(1 + overhead, system.models[task].deadline + overhead + 1, good) - overhead;
}

// Those that it reads at its instant have to end by then, too, and those that these read.
void shorten_deadline(System& system, std::size_t task, std::int64_t deadline) {
  system.models[task].deadline = deadline;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [producer, reader] : system.follows) {
      if (system.models[producer].deadline <= system.models[reader].deadline) continue;
      system.models[producer].deadline = system.models[reader].deadline;
      changed = true;
    }
  }
}

std::optional<std::int64_t> min_deadline(const System& system, std::size_t task, Budget& budget) {
  // negated: the search looks for the largest
  const auto good = [&](std::int64_t negative) {
    System changed = system;
    shorten_deadline(changed, task, -negative);
    return holds(changed, budget);
  };
  const std::int64_t now = system.models[task].deadline;
  if (!good(-now)) return std::nullopt;
  return -largest(-now, 0, good);
}

}  // namespace

std::optional<Sensitivity> sensitivity_of(const System& system, bool per_task, Budget& budget) {
  Sensitivity result;
  result.max_wcet.resize(system.models.size());
  result.min_deadline.resize(system.models.size());
  const bool any =
      std::any_of(system.models.begin(), system.models.end(), [](const TaskModel& m) { return m.wcet > 0; });
  if (any && holds(scaled(system, 1), budget)) {
    std::int64_t high = 1'000'000;
    while (high < 1'000'000'000'000 && holds(scaled(system, high), budget)) high *= 2;
    const std::int64_t factor = largest(high == 1'000'000 ? 1 : high / 2, high,
                                        [&](std::int64_t f) { return holds(scaled(system, f), budget); });
    result.alpha = static_cast<double>(factor) * 1e-6;
  }
  if (budget.spent()) return std::nullopt;
  if (!per_task) return result;
  double min = 0;
  for (std::size_t i = 0; i < system.models.size(); ++i) {
    result.max_wcet[i] = max_wcet(system, i, budget);
    result.min_deadline[i] = min_deadline(system, i, budget);
    if (!result.max_wcet[i] || system.models[i].wcet == system.models[i].overhead) continue;
    const double room = static_cast<double>(*result.max_wcet[i]) /
                        static_cast<double>(system.models[i].wcet - system.models[i].overhead);
    if (result.binding && room >= min) continue;
    min = room;
    result.binding = i;
  }
  if (budget.spent()) return std::nullopt;  // the last ones were given up
  return result;
}

std::vector<WcetCut> wcet_cuts(const System& system, Budget& budget) {
  if (system.models.size() > 100) return {};
  std::vector<std::pair<double, WcetCut>> cuts;
  for (std::size_t i = 0; i < system.models.size(); ++i) {
    const std::int64_t now = system.models[i].wcet - system.models[i].overhead;
    const auto wcet = max_wcet(system, i, budget);
    if (!wcet || budget.spent() || *wcet >= now) continue;
    cuts.push_back({1 - static_cast<double>(*wcet) / static_cast<double>(now), {i, *wcet}});
  }
  std::stable_sort(cuts.begin(), cuts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<WcetCut> sorted;
  for (const auto& [cut, of_task] : cuts) sorted.push_back(of_task);
  return sorted;
}

}  // namespace jarol::analysis
