#include "graph/analysis/check_graph.h"

#include <algorithm>
#include <utility>

#include "graph/analysis/all_paths.h"

namespace jarol::analysis {
namespace {

// About how many steps one verdict takes.
double cost_of(const System& system) {
  const auto n = static_cast<double>(system.models.size());
  if (system.policy.urgency != Urgency::turn && !system.offsets_hold) return n * n;
  const auto lcm = hyperperiod(system.models, max_time);
  double activations = 0;
  for (const TaskModel& m : system.models)
    activations += lcm ? 2 * static_cast<double>(lcm->count()) / static_cast<double>(m.period.count()) : 1e6;
  return std::max(n * n, activations);
}

// As a chain that the graph could name.
Chain chain_of(const Graph& graph, std::vector<End> path) {
  Chain chain;
  for (const End& end : path)
    chain.name += (chain.name.empty() ? "" : " -> ") +
                  (end.kind == End::Kind::task ? graph.tasks[end.index].name : graph.communicators[end.index].name);
  chain.path = std::move(path);
  return chain;
}

}  // namespace

GraphCheck check_graph(const Graph& graph, bool sensitivity, bool all_chains) {
  GraphCheck found;
  found.graph = &graph;
  found.result = check(graph);
  Budget of_chains{max_steps_of_chains};
  for (const Chain& c : graph.chains) found.chains.push_back({c, latency_of(graph, c.path, of_chains)});
  if (all_chains) {
    AllPaths all = all_paths(graph);
    found.more_paths = all.more;
    found.all_walked = all.whole;
    for (std::vector<End>& path : all.paths) {
      Chain chain = chain_of(graph, std::move(path));
      const ChainLatency latency = latency_of(graph, chain.path, of_chains);
      found.chains.push_back({std::move(chain), latency});
    }
  }
  const bool stated = std::all_of(graph.tasks.begin(), graph.tasks.end(), [](const Task& t) { return t.wcet; });
  if (!stated) return found;
  // what is quick comes without being asked for
  const System system = system_of(graph);
  constexpr double quick = 5e6, searches = 40;
  const double cost = searches * cost_of(system), per_task = cost * static_cast<double>(graph.tasks.size());
  // close to full utilisation, or with many ways to spread tasks over cores, a test may take much longer than that
  Budget budget;
  if (!sensitivity) budget.left = 30'000'000;
  if (sensitivity || cost < quick) found.sensitivity = sensitivity_of(system, sensitivity || per_task < quick, budget);
  if (found.sensitivity) confirm_deadlines(graph, *found.sensitivity, budget);
  return found;
}

std::optional<bool> holds(const CheckedChain& c) {
  if (broken_limits(c.chain, c.latency).empty()) return true;
  return c.latency.exact ? std::optional(false) : std::nullopt;
}

std::optional<bool> chains_hold(const GraphCheck& check) {
  std::optional<bool> all = true;
  for (const CheckedChain& chain : check.chains) {
    const std::optional<bool> one = holds(chain);
    if (one == false) return false;
    if (!one) all.reset();
  }
  return all;
}

}  // namespace jarol::analysis
