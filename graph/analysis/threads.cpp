#include "graph/analysis/threads.h"

#include <algorithm>

#include "graph/analysis/check.h"
#include "graph/analysis/urgency.h"
#include "graph/model/deadlines.h"

namespace jarol::analysis {
namespace {

// Is the second always released with the first, and run after it by a thread that has both?
bool follows(const System& system, std::size_t first, std::size_t second) {
  const TaskModel &a = system.models[first], &b = system.models[second];
  return a.period == b.period && a.offset == b.offset && system.turn[first] < system.turn[second];
}

// Does it wait for a task of another thread? Those behind it would wait with it.
bool waits(const System& system, std::size_t task, const std::vector<std::size_t>& thread) {
  return std::any_of(system.follows.begin(), system.follows.end(), [&](const auto& pair) {
    return pair.second == task && std::find(thread.begin(), thread.end(), pair.first) == thread.end();
  });
}

}  // namespace

std::vector<TaskThread> threads_of(const Graph& graph) {
  const System system = system_of(graph);
  const std::vector<std::optional<std::size_t>> core_of = check(system).core;
  std::vector<TaskThread> threads;
  for (std::size_t core = 0; core < static_cast<std::size_t>(system.cores); ++core) {
    std::vector<std::size_t> tasks;
    for (std::size_t i = 0; i < core_of.size(); ++i)
      if (core_of[i] == core) tasks.push_back(i);
    tasks = in_order(system, std::move(tasks));
    const std::size_t first = threads.size();
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const bool shares =
          i > 0 && (system.policy.urgency == Urgency::turn ||
                    (follows(system, tasks[i - 1], tasks[i]) && !waits(system, tasks[i - 1], threads.back().tasks)));
      if (!shares) threads.push_back({core, threads.size() - first, {}});
      threads.back().tasks.push_back(tasks[i]);
    }
  }
  return threads;
}

bool is_due_meanwhile(const Graph& graph) {
  const Result result = check(graph);
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Task& task = graph.tasks[i];
    if (!task.wcet || !result.response[i]) continue;
    const Duration response = *result.response[i];
    if (std::any_of(graph.communicators.begin(), graph.communicators.end(), [&](const Communicator& c) {
          return min_distance(task.period, task.offset, c.period, c.offset) < response;
        }))
      return true;
  }
  return false;
}

}  // namespace jarol::analysis
