#include "graph/analysis/time_table.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace jarol::analysis {
namespace {

__extension__ using Wide = __int128;

struct Job {
  std::int64_t release = 0;
  std::size_t rank = 0;  // in data-flow order
  std::size_t task = 0;
  std::int64_t activation = 0;
};

bool later(const Job& a, const Job& b) { return std::tie(a.release, a.rank) > std::tie(b.release, b.rank); }

// Least common multiple of all periods, or nothing once it is beyond `most`.
std::optional<std::int64_t> hyperperiod(const Graph& graph, std::int64_t most) {
  std::int64_t lcm = 1;
  for (const Task& task : graph.tasks) {
    const std::int64_t period = task.period.count();
    const Wide next = static_cast<Wide>(lcm) / std::gcd(lcm, period) * period;
    if (next > most) return std::nullopt;
    lcm = static_cast<std::int64_t>(next);
  }
  return lcm;
}

// Sum of C/T against 1 without rounding: -1, 0 or 1, or nothing if the common denominator is out of reach.
std::optional<int> compare_utilisation(const Graph& graph, std::int64_t lcm) {
  Wide demand = 0;
  for (const Task& task : graph.tasks) demand += static_cast<Wide>(task.wcet->count()) * (lcm / task.period.count());
  return demand < lcm ? -1 : demand == lcm ? 0 : 1;
}

std::string names_without_wcet(const Graph& graph) {
  std::vector<std::string> names;
  for (const Task& task : graph.tasks)
    if (!task.wcet) names.push_back("'" + task.name + "'");
  return list_of(names);
}

}  // namespace

TableResult check_table(const Graph& graph, std::uint64_t most_jobs) {
  TableResult result;
  for (const Task& task : graph.tasks)
    if (task.wcet)
      result.utilisation += static_cast<double>(task.wcet->count()) / static_cast<double>(task.period.count());
  const std::string missing = names_without_wcet(graph);
  if (missing != "nothing") {
    result.reason = "no 'wcet' is stated for " + missing;
    return result;
  }
  if (graph.platform.policy != Policy::table || graph.platform.cores != 1) {
    result.reason = "only 'policy: table' on one core is analysed yet";
    return result;
  }
  constexpr std::int64_t most_time = std::int64_t{1} << 60;
  const auto lcm = hyperperiod(graph, most_time);
  if (lcm && compare_utilisation(graph, *lcm) == 1) {
    result.verdict = Verdict::not_schedulable;
    result.reason = "the tasks need more than the whole core";
  }
  Duration largest_offset{};
  for (const Task& task : graph.tasks) largest_offset = std::max(largest_offset, task.offset);
  const std::int64_t end = lcm && *lcm <= most_time / 4 ? largest_offset.count() + 2 * *lcm : most_time;
  std::vector<std::size_t> rank(graph.tasks.size());
  for (std::size_t i = 0; i < graph.order.size(); ++i) rank[graph.order[i]] = i;
  std::priority_queue<Job, std::vector<Job>, decltype(&later)> jobs(&later);
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) jobs.push({graph.tasks[i].offset.count(), rank[i], i, 0});
  result.response.resize(graph.tasks.size());
  std::int64_t finish = 0;
  for (std::uint64_t count = 0; !jobs.empty() && jobs.top().release < end; ++count) {
    if (count == most_jobs) {
      if (result.verdict == Verdict::unknown)
        result.reason =
            "the periods repeat only after more than " + std::to_string(most_jobs) + " jobs, and none of these is late";
      result.response.clear();
      return result;
    }
    Job job = jobs.top();
    jobs.pop();
    const Task& task = graph.tasks[job.task];
    finish = std::max(finish, job.release) + task.wcet->count();
    result.response[job.task] = std::max(result.response[job.task], Duration(finish - job.release));
    if (finish > job.release + task.deadline.count()) {
      if (result.verdict == Verdict::unknown) result.reason = "a task is late when every task takes its 'wcet'";
      result.verdict = Verdict::not_schedulable;
      result.miss = Miss{job.task, job.activation, Duration(job.release), Duration(finish),
                         Duration(job.release) + task.deadline};
      result.response.clear();
      return result;
    }
    job.release += task.period.count();
    ++job.activation;
    jobs.push(job);
  }
  if (result.verdict == Verdict::unknown) {
    result.verdict = Verdict::schedulable;
    result.reason = "every job of the time table ends by its deadline";
  }
  return result;
}

}  // namespace jarol::analysis
