#include "tools/commands/check/check_graph.h"

#include <algorithm>

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

// Per task, whether a path leads from it to an `out`: where none does, there may be more ways than anyone can walk.
std::vector<bool> tasks_before_outs(const Graph& graph) {
  std::vector<bool> before(graph.tasks.size());
  for (bool more = true; more;) {
    more = false;
    for (const Connection& c : graph.connections) {
      if (c.from.kind != End::Kind::task || before[c.from.index]) continue;
      if (c.to.kind == End::Kind::task && !before[c.to.index]) continue;
      before[c.from.index] = more = true;
    }
  }
  return before;
}

// Every path from an `in` to an `out`, as far as there are not too many.
void add_paths(const Graph& graph, const std::vector<bool>& before_outs, std::vector<End>& path,
               std::vector<ReportedChain>& paths) {
  const End at = path.back();
  if (at.kind == End::Kind::communicator && path.size() > 1) {
    std::string name;
    for (const End& end : path)
      name += (name.empty() ? "" : " -> ") +
              (end.kind == End::Kind::task ? graph.tasks[end.index].name : graph.communicators[end.index].name);
    Chain chain;
    chain.name = name;
    chain.path = path;
    paths.push_back({chain, analysis::latency_of(graph, path)});
    return;
  }
  const auto same = [](const End& a, const End& b) { return a.kind == b.kind && a.index == b.index; };
  std::vector<End> next;
  for (const Connection& c : graph.connections) {
    const auto is_to = [&](const End& end) { return same(end, c.to); };
    if (!same(c.from, at) || std::any_of(path.begin(), path.end(), is_to)) continue;
    if (c.to.kind == End::Kind::task && !before_outs[c.to.index]) continue;
    if (!std::any_of(next.begin(), next.end(), is_to)) next.push_back(c.to);
  }
  for (const End& end : next) {
    if (paths.size() > max_paths) return;
    path.push_back(end);
    add_paths(graph, before_outs, path, paths);
    path.pop_back();
  }
}

}  // namespace

CheckReport check_graph(const std::string& file, const Graph& graph, bool sensitivity, bool all_chains) {
  CheckReport report;
  report.file = file;
  report.graph = &graph;
  report.result = analysis::check(graph);
  for (const Chain& c : graph.chains) report.chains.push_back({c, analysis::latency_of(graph, c.path)});
  if (all_chains) {
    std::vector<ReportedChain> paths;
    const std::vector<bool> before_outs = tasks_before_outs(graph);
    for (std::size_t i = 0; i < graph.communicators.size(); ++i) {
      std::vector<End> path{{End::Kind::communicator, i, 0}};
      if (graph.communicators[i].direction == Direction::in) add_paths(graph, before_outs, path, paths);
    }
    report.more_paths = paths.size() > max_paths;
    if (report.more_paths) paths.resize(max_paths);
    report.chains.insert(report.chains.end(), paths.begin(), paths.end());
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
