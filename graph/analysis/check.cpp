#include "graph/analysis/check.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "graph/analysis/global_edf.h"
#include "graph/analysis/partition.h"
#include "graph/analysis/simulate_global.h"
#include "graph/analysis/time_table.h"
#include "graph/analysis/urgency.h"
#include "graph/yaml/problems.h"

namespace jarol::analysis {
namespace {

Loads loads_of(const System& system, const std::vector<std::size_t>& tasks) {
  Loads loads;
  for (const std::size_t i : tasks) loads.push_back(system.loads[i]);
  return loads;
}

// What no policy on one core can know, or nothing.
std::string precedence_problem(const System& s, const std::vector<std::size_t>& core) {
  const bool by_priority = s.policy == Policy::fixed_priority || s.policy == Policy::fixed_priority_nonpreemptive;
  for (const auto& [producer, reader] : s.follows) {
    if (core[producer] != core[reader])
      return "a task follows another of its instant on another core, which only 'policy: table' analyses";
    if (by_priority && more_urgent(s, reader, producer))
      return "a task has a higher priority than one that it follows at the same instant; give the producer the "
             "higher one";
  }
  return "";
}

Result check_on_table(const System& system) {
  const auto fits = [&](const std::vector<std::size_t>& tasks) {
    const auto order = compare_utilisation(loads_of(system, tasks), 1);
    return !order || *order <= 0 ? Verdict::schedulable : Verdict::not_schedulable;
  };
  Result result;
  const Partition partition = assign_cores(system, fits);
  CoreResult table = check_table(system, partition.core);
  result.core.assign(partition.core.begin(), partition.core.end());
  result.verdict = table.verdict;
  result.standing = table.standing;
  result.reason = table.reason;
  result.response = table.responses;
  if (system.cores > 1 && table.verdict == Verdict::not_schedulable) {
    // another assignment could hold, unless all are given
    const bool given = std::all_of(system.core.begin(), system.core.end(), [](const auto& c) { return c.has_value(); });
    const auto order = compare_utilisation(system.loads, system.cores);
    if (!given && !(order && *order > 0)) {
      result.verdict = Verdict::unknown;
      result.standing = Standing::sufficient;
      result.reason += " with the cores that were assigned; 'core:' per task may say better ones";
    }
  }
  result.late = table.late;
  if (table.late) {
    result.core_at_fault = partition.core[table.late->task];
    for (const Slice& s : table.slices)
      if (partition.core[s.task] == *result.core_at_fault) result.slices.push_back(s);
  }
  return result;
}

// What happens from the offsets on, where that proves something.
void walk_globally(const System& system, Result& result, Effort& effort) {
  constexpr std::uint64_t most_activations = 1'000'000, steps_of_activation = 40;
  const GlobalSimulation run =
      simulate_global(system.loads, system.cores, std::min(most_activations, effort.left / steps_of_activation));
  effort.spend(run.activations * steps_of_activation);
  if (run.late) {
    if (result.verdict != Verdict::not_schedulable) result.reason = "a task is late when every task takes its 'wcet'";
    result.verdict = Verdict::not_schedulable;
    result.standing = Standing::proof;
    result.late = run.late;
    result.slices = run.slices;
    return;
  }
  const bool only_offsets = std::all_of(system.loads.begin(), system.loads.end(),
                                        [](const Load& l) { return l.jitter == 0 && l.blocking == 0; });
  if (!run.repeats || !system.offsets_hold || !only_offsets || result.verdict == Verdict::not_schedulable) return;
  result.verdict = Verdict::schedulable;
  result.standing = Standing::proof;
  result.reason =
      "every activation of the whole repetition ends by its deadline, where those of equal deadlines go in "
      "order of name";
  result.response.assign(run.responses.begin(), run.responses.end());
}

// `whole`: with a witness where none is needed.
Result check_globally(const System& system, bool whole, Effort& effort) {
  Result result;
  result.response = global_edf_responses(system.loads, system.cores);
  result.core.resize(system.loads.size());
  const bool bounded =
      std::all_of(result.response.begin(), result.response.end(), [](const auto& r) { return r.has_value(); });
  const auto order = compare_utilisation(system.loads, system.cores);
  if (order && *order > 0) {
    result.verdict = Verdict::not_schedulable;
    result.standing = Standing::proof;
    result.reason = "the tasks need more than all cores";
    if (!whole) return result;
  } else if (!system.follows.empty()) {
    result.reason = "tasks follow each other at one instant, which is not analysed under global_edf";
    return result;
  } else if (bounded || passes_gfb(system.loads, system.cores)) {
    result.verdict = Verdict::schedulable;
    result.standing = Standing::proof;
    result.reason = bounded ? "every task's response is bounded within its deadline (Bertogna, Cirinei)"
                            : "the densities fit the cores (Goossens, Funk, Baruah)";
    return result;
  } else {
    result.standing = Standing::sufficient;
    result.reason = "the tests of global_edf are sufficient only, and none of them holds";
  }
  walk_globally(system, result, effort);
  return result;
}

constexpr std::uint64_t most_steps_to_assign = 300'000'000;

// Core by core, with each policy's own test. `whole`: with witness and responses.
Result check_partitioned(const System& system, bool whole, Effort& effort) {
  const Partition partition = within(effort, most_steps_to_assign, [&](Effort& own) {
    return assign_cores(system, [&](const std::vector<std::size_t>& tasks) {
      return verdict_of_core(loads_of(system, in_order(system, tasks)), system.policy, system.offsets_hold, own);
    });
  });
  Result result;
  result.response.resize(system.loads.size());
  result.core.assign(partition.core.begin(), partition.core.end());
  result.reason = precedence_problem(system, partition.core);
  if (!result.reason.empty()) return result;
  result.verdict = Verdict::schedulable;
  result.standing = Standing::proof;
  if (system.loads.empty()) result.reason = "there is no task to be late";
  for (std::size_t c = 0; c < static_cast<std::size_t>(system.cores); ++c) {
    std::vector<std::size_t> tasks;
    for (std::size_t i = 0; i < partition.core.size(); ++i)
      if (partition.core[i] == c) tasks.push_back(i);
    if (tasks.empty()) continue;
    tasks = in_order(system, std::move(tasks));
    const Loads loads = loads_of(system, tasks);
    CoreResult core;
    if (whole)
      core = check_core(loads, system.policy, system.offsets_hold);
    else
      core.verdict = verdict_of_core(loads, system.policy, system.offsets_hold, effort);
    for (std::size_t i = 0; i < tasks.size() && whole; ++i) result.response[tasks[i]] = core.responses[i];
    if (result.reason.empty() || (result.verdict == Verdict::schedulable && core.verdict != Verdict::schedulable))
      result.reason = core.reason;
    if (core.verdict == Verdict::schedulable || result.verdict == Verdict::not_schedulable) continue;
    result.verdict = core.verdict;
    result.standing = core.standing;
    if (core.verdict != Verdict::not_schedulable) continue;
    result.core_at_fault = c;
    result.demand = core.demand;
    if (core.late) {
      core.late->task = tasks[core.late->task];
      result.late = core.late;
    }
    for (Slice s : core.slices) {
      s.task = tasks[s.task];
      result.slices.push_back(s);
    }
  }
  const bool all_given =
      std::all_of(system.core.begin(), system.core.end(), [](const auto& c) { return c.has_value(); });
  if (system.cores > 1 && result.verdict == Verdict::not_schedulable && !all_given) {
    const auto order = compare_utilisation(system.loads, system.cores);
    if (partition.refuted) {
      result.reason += "; no assignment of tasks to cores holds";
    } else if (!(order && *order > 0)) {
      result.verdict = Verdict::unknown;
      result.standing = Standing::sufficient;
      result.reason += " with the cores that were assigned; another assignment may hold";
    }
  }
  return result;
}

bool is_edf_by_another_name(const System& system) { return system.policy == Policy::global_edf && system.cores == 1; }

System with_edf(System system) {
  system.policy = Policy::edf;
  return system;
}

}  // namespace

Result check(const System& system) {
  if (is_edf_by_another_name(system)) return check(with_edf(system));
  Effort effort;
  Result result = system.policy == Policy::table        ? check_on_table(system)
                  : system.policy == Policy::global_edf ? check_globally(system, true, effort)
                                                        : check_partitioned(system, true, effort);
  assert(result.response.size() == system.loads.size() && result.core.size() == system.loads.size());
  result.utilisation = utilisation(system.loads);
  return result;
}

Verdict verdict_of(const System& system, Effort& effort) {
  if (is_edf_by_another_name(system)) return verdict_of(with_edf(system), effort);
  if (system.policy == Policy::table) return check(system).verdict;
  if (system.policy == Policy::global_edf) return check_globally(system, false, effort).verdict;
  return check_partitioned(system, false, effort).verdict;
}

Result check(const Graph& graph) {
  std::vector<std::string> missing;
  for (const Task& task : graph.tasks)
    if (!task.wcet) missing.push_back("'" + task.name + "'");
  const System system = system_of(graph);
  if (missing.empty()) return check(system);
  Result result;
  result.reason = "no 'wcet' is stated for " + list_of(missing);
  result.utilisation = utilisation(system.loads);
  result.response.resize(graph.tasks.size());
  result.core.resize(graph.tasks.size());
  return result;
}

}  // namespace jarol::analysis
