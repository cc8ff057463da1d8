#include "graph/analysis/threads.h"

#include "graph/analysis/check.h"
#include "graph/analysis/urgency.h"

namespace jarol::analysis {
namespace {

// Is the second always released with the first, and run after it by a thread that has both?
bool follows(const System& system, std::size_t first, std::size_t second) {
  const TaskModel &a = system.models[first], &b = system.models[second];
  return a.period == b.period && a.offset == b.offset && system.turn[first] < system.turn[second];
}

// Per task, whether it follows one on another core: those behind it must not wait with it.
std::vector<bool> waiting_of(const System& system, const std::vector<std::optional<std::size_t>>& core_of) {
  std::vector<bool> waits(system.models.size(), false);
  for (const auto& [producer, reader] : system.follows)
    waits[reader] = waits[reader] || core_of[producer] != core_of[reader];
  return waits;
}

}  // namespace

std::vector<TaskThread> threads_of(const Graph& graph) {
  const System system = system_of(graph);
  const std::vector<std::optional<std::size_t>> core_of = check(system).core;
  const std::vector<bool> waits = waiting_of(system, core_of);
  std::vector<TaskThread> threads;
  for (std::size_t core = 0; core < static_cast<std::size_t>(system.cores); ++core) {
    std::vector<std::size_t> tasks;
    for (std::size_t i = 0; i < core_of.size(); ++i)
      if (core_of[i] == core) tasks.push_back(i);
    tasks = in_order(system, std::move(tasks));
    const std::size_t first = threads.size();
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const bool shares = i > 0 && (system.policy.urgency == Urgency::turn ||
                                    (follows(system, tasks[i - 1], tasks[i]) && !waits[tasks[i - 1]]));
      if (!shares) threads.push_back({core, threads.size() - first, {}});
      threads.back().tasks.push_back(tasks[i]);
    }
  }
  return threads;
}

}  // namespace jarol::analysis
