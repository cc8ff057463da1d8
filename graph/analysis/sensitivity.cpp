#include "graph/analysis/sensitivity.h"

#include <algorithm>
#include <cmath>

namespace jarol::analysis {
namespace {

bool holds(const System& system, Budget& budget) { return verdict_of(system, budget) == Verdict::schedulable; }

// The largest x in [low, high) with good(x), where good is monotone and good(low).
template <class T, class Good>
T largest(T low, T high, const Good& good) {
  while (high - low > T{1}) {
    const T middle = low + (high - low) / 2;
    (good(middle) ? low : high) = middle;
  }
  return low;
}

System scaled(const System& system, std::int64_t millionths) {
  System changed = system;
  for (TaskModel& m : changed.models)
    m.wcet = m.overhead + Duration(static_cast<std::int64_t>(
                              (static_cast<Wide>((m.wcet - m.overhead).count()) * millionths + 999'999) / 1'000'000));
  return changed;
}

std::optional<Duration> max_wcet(const System& system, std::size_t task, Budget& budget) {
  System changed = system;
  const auto good = [&](Duration wcet) {
    changed.models[task].wcet = wcet;
    return holds(changed, budget);
  };
  const Duration overhead = system.models[task].overhead;
  constexpr Duration step(1);
  if (!good(overhead + step)) return std::nullopt;
  return largest(overhead + step, system.models[task].deadline + overhead + step, good) - overhead;
}

std::optional<Duration> min_deadline(const System& system, std::size_t task, Budget& budget) {
  // negated: the search looks for the largest
  const auto good = [&](Duration negative) { return holds(with_deadline(system, task, -negative), budget); };
  const Duration now = system.models[task].deadline;
  if (!good(-now)) return std::nullopt;
  return -largest(-now, Duration{}, good);
}

}  // namespace

System with_deadline(const System& system, std::size_t task, Duration deadline) {
  System changed = system;
  changed.models[task].deadline = deadline;
  // those that it reads have to end by then, too, and those that these read
  for (bool shortened = true; shortened;) {
    shortened = false;
    for (const auto& [producer, reader] : changed.follows) {
      if (changed.models[producer].deadline <= changed.models[reader].deadline) continue;
      changed.models[producer].deadline = changed.models[reader].deadline;
      shortened = true;
    }
  }
  return changed;
}

void confirm_deadlines(const Graph& graph, Sensitivity& sensitivity, Budget& budget) {
  const System system = system_of(graph);
  if (system.policy.urgency != Urgency::turn) return;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    if (!sensitivity.min_deadline[i]) continue;
    const System shorter = with_deadline(system, i, *sensitivity.min_deadline[i]);
    Graph changed = graph;
    for (std::size_t k = 0; k < changed.tasks.size(); ++k) changed.tasks[k].deadline = shorter.models[k].deadline;
    if (!holds(system_of(changed), budget)) sensitivity.min_deadline[i].reset();
  }
}

std::optional<Sensitivity> sensitivity_of(const System& system, bool per_task, Budget& budget) {
  Sensitivity result;
  result.max_wcet.resize(system.models.size());
  result.min_deadline.resize(system.models.size());
  const bool any =
      std::any_of(system.models.begin(), system.models.end(), [](const TaskModel& m) { return m.wcet > Duration{}; });
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
    const double room = static_cast<double>(result.max_wcet[i]->count()) /
                        static_cast<double>((system.models[i].wcet - system.models[i].overhead).count());
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
    const Duration now = system.models[i].wcet - system.models[i].overhead;
    const auto wcet = max_wcet(system, i, budget);
    if (!wcet || budget.spent() || *wcet >= now) continue;
    cuts.push_back({1 - static_cast<double>(wcet->count()) / static_cast<double>(now.count()), {i, *wcet}});
  }
  std::stable_sort(cuts.begin(), cuts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<WcetCut> sorted;
  for (const auto& [cut, of_task] : cuts) sorted.push_back(of_task);
  return sorted;
}

}  // namespace jarol::analysis
