// A time table on each core: which task on which core, then the walk.
#include <algorithm>

#include "graph/analysis/partition.h"
#include "graph/analysis/systems.h"
#include "graph/analysis/time_table.h"

namespace jarol::analysis {
namespace {

// These tasks alone, on one core.
System alone(const System& system, std::vector<std::size_t> tasks) {
  std::sort(tasks.begin(), tasks.end());
  System part;
  part.policy = system.policy;
  part.offsets_hold = system.offsets_hold;
  for (const std::size_t i : tasks) {
    part.models.push_back(system.models[i]);
    part.turn.push_back(system.turn[i]);
  }
  return part;
}

}  // namespace

Result check_on_table(const System& system, bool whole, Budget& budget) {
  constexpr std::uint64_t max_steps_to_assign = 300'000'000;
  Result result;
  const auto fits = [&](const std::vector<std::size_t>& tasks, Budget& own) {
    return check_table(alone(system, tasks), std::vector<std::size_t>(tasks.size(), 0), false, own).verdict;
  };
  const auto holds = [&](const std::vector<std::size_t>& core, Budget& own) {
    return check_table(system, core, false, own).verdict;
  };
  const Partition partition =
      system.offsets_hold
          ? within(budget, max_steps_to_assign, [&](Budget& own) { return assign_cores(system, fits, holds, own); })
          : Partition{std::vector<std::size_t>(system.models.size(), 0), false, false};
  CoreResult table = check_table(system, partition.core, whole, budget);
  result.core.assign(partition.core.begin(), partition.core.end());
  result.verdict = table.verdict;
  result.evidence = table.evidence;
  result.reason = table.reason;
  result.response = table.responses;
  result.exact.assign(system.models.size(), table.exact);
  qualify_no(system, partition, result.verdict, result.evidence, result.reason);
  if (result.verdict != Verdict::schedulable) result.late = table.late;
  if (table.late) {
    result.core_at_fault = partition.core[table.late->task];
    result.slices_from = table.slices_from;
    for (const Slice& s : table.slices)
      if (partition.core[s.task] == *result.core_at_fault) result.slices.push_back(s);
  }
  return result;
}

}  // namespace jarol::analysis
