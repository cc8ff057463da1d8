#include "tools/commands/check/check_graph.h"

#include <algorithm>
#include <utility>

#include "tools/commands/check/all_paths.h"

namespace jarol::tools {
namespace {

// About how many steps one verdict takes.
double cost_of(const analysis::System& system) {
  const auto n = static_cast<double>(system.models.size());
  if (system.policy.urgency != Urgency::turn && !system.offsets_hold) return n * n;
  const auto lcm = analysis::hyperperiod(system.models, std::int64_t{1} << 60);
  double activations = 0;
  for (const analysis::TaskModel& m : system.models)
    activations += lcm ? 2 * static_cast<double>(*lcm) / static_cast<double>(m.period) : 1e6;
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

CheckReport check_graph(const std::string& file, const Graph& graph, bool sensitivity, bool all_chains) {
  CheckReport report;
  report.file = file;
  report.graph = &graph;
  report.result = analysis::check(graph);
  analysis::Budget of_chains{analysis::max_steps_of_chains};
  for (const Chain& c : graph.chains) report.chains.push_back({c, analysis::latency_of(graph, c.path, of_chains)});
  if (all_chains) {
    AllPaths all = all_paths(graph);
    report.more_paths = all.more;
    report.all_walked = all.whole;
    for (std::vector<End>& path : all.paths) {
      Chain chain = chain_of(graph, std::move(path));
      const analysis::ChainLatency latency = analysis::latency_of(graph, chain.path, of_chains);
      report.chains.push_back({std::move(chain), latency});
    }
  }
  const bool stated = std::all_of(graph.tasks.begin(), graph.tasks.end(), [](const Task& t) { return t.wcet; });
  if (!stated) return report;
  // what is quick comes without being asked for
  const analysis::System system = analysis::system_of(graph);
  constexpr double quick = 5e6, searches = 40;
  const double cost = searches * cost_of(system), per_task = cost * static_cast<double>(graph.tasks.size());
  // close to full utilisation, or with many ways to spread tasks over cores, a test may take much longer than that
  analysis::Budget budget;
  if (!sensitivity) budget.left = 30'000'000;
  if (sensitivity || cost < quick)
    report.sensitivity = analysis::sensitivity_of(system, sensitivity || per_task < quick, budget);
  if (report.sensitivity) analysis::confirm_deadlines(graph, *report.sensitivity, budget);
  return report;
}

}  // namespace jarol::tools
