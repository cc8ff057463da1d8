#include "graph/analysis/time_table.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "graph/analysis/validate_table.h"

namespace jarol::analysis {
namespace {

struct Job {
  std::int64_t release = 0;
  std::size_t turn = 0;  // among those released at one instant
  std::size_t task = 0;
  std::int64_t activation = 0;
};

bool later(const Job& a, const Job& b) { return std::tie(a.release, a.turn) > std::tie(b.release, b.turn); }

// Does any core have more to do than there is time?
bool overloaded(const System& system, const std::vector<std::size_t>& core) {
  std::vector<Loads> of_core(static_cast<std::size_t>(system.cores));
  for (std::size_t i = 0; i < system.loads.size(); ++i) of_core[core[i]].push_back(system.loads[i]);
  return std::any_of(of_core.begin(), of_core.end(), [](const Loads& loads) {
    const auto order = compare_utilisation(loads, 1);
    return order && *order > 0;
  });
}

}  // namespace

CoreResult check_table(const System& system, const std::vector<std::size_t>& core, std::uint64_t most) {
  constexpr std::size_t most_slices = 200;
  constexpr std::size_t most_validated = 50'000;
  constexpr std::int64_t most_time = std::int64_t{1} << 60;
  const std::size_t n = system.loads.size();
  CoreResult result;
  result.responses.resize(n);
  std::vector<Slice> recent;  // beyond those that are kept for the validation
  if (!system.offsets_hold) {
    result.reason = "a table needs offsets that hold; 'phasing: any' has none";
    return result;
  }
  const bool too_much = overloaded(system, core);
  if (too_much) {
    result.verdict = Verdict::not_schedulable;
    result.standing = Standing::proof;
    result.reason = "the tasks need more than the whole core";
  }
  const auto lcm = hyperperiod(system.loads, most_time / 4);
  std::int64_t largest_offset = 0;
  for (const Load& l : system.loads) largest_offset = std::max(largest_offset, l.offset);
  const std::int64_t end = lcm ? largest_offset + 2 * *lcm : most_time;
  std::vector<std::vector<std::size_t>> producers(n);
  for (const auto& [producer, reader] : system.follows)
    if (core[producer] != core[reader]) producers[reader].push_back(producer);
  std::vector<std::int64_t> released(n, -1), ended(n, 0), response(n, 0),
      free(static_cast<std::size_t>(system.cores), 0);
  std::priority_queue<Job, std::vector<Job>, decltype(&later)> jobs(&later);
  for (std::size_t i = 0; i < n; ++i) jobs.push({system.loads[i].offset, system.turn[i], i, 0});
  for (std::uint64_t count = 0; !jobs.empty() && jobs.top().release < end; ++count) {
    if (count == most) {
      if (!too_much)
        result.reason = "the periods repeat only after more than " + std::to_string(most) +
                        " activations, and none of these is late";
      return result;
    }
    Job job = jobs.top();
    jobs.pop();
    const Load& load = system.loads[job.task];
    std::int64_t start = std::max(free[core[job.task]], job.release + load.jitter);
    for (const std::size_t p : producers[job.task])
      if (released[p] == job.release) start = std::max(start, ended[p]);
    const std::int64_t finish = start + load.blocking + load.wcet;
    free[core[job.task]] = ended[job.task] = finish;
    released[job.task] = job.release;
    response[job.task] = std::max(response[job.task], finish - job.release);
    if (result.slices.size() < most_validated)
      result.slices.push_back({job.task, job.activation, start, finish});
    else
      recent.push_back({job.task, job.activation, start, finish});
    if (recent.size() >= 2 * most_slices) recent.erase(recent.begin(), recent.begin() + most_slices);
    if (finish > job.release + load.deadline) {
      if (!too_much) result.reason = "a task is late when every task takes its 'wcet'";
      result.verdict = Verdict::not_schedulable;
      result.standing = Standing::proof;
      // the last ones tell why
      result.slices.insert(result.slices.end(), recent.begin(), recent.end());
      if (result.slices.size() > most_slices)
        result.slices.erase(result.slices.begin(), result.slices.end() - static_cast<std::ptrdiff_t>(most_slices));
      result.late = Late{job.task, job.activation, job.release, finish, job.release + load.deadline};
      return result;
    }
    job.release += load.period;
    ++job.activation;
    jobs.push(job);
  }
  const std::string fault = recent.empty() && !too_much ? fault_of_table(system, core, result.slices, end) : "";
  result.slices.clear();
  result.responses.assign(response.begin(), response.end());
  if (!fault.empty()) {
    result.reason = "the table that was found is wrong, please report this: " + fault;
    return result;
  }
  if (!too_much) {
    result.verdict = Verdict::schedulable;
    result.standing = Standing::proof;
    result.reason = "every job of the time table ends by its deadline";
  }
  return result;
}

}  // namespace jarol::analysis
