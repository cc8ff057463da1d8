#include "distributers/session/reached.h"

#include <algorithm>

#include "graph/model/condition.h"

namespace jarol {
namespace {

std::optional<Reported::Command> find_command(const Graph& graph, const Communicator& out, const Leaf& leaf) {
  for (std::size_t i = 0; i < graph.communicators.size(); ++i) {
    const Communicator& in = graph.communicators[i];
    if (in.direction != Direction::in || in.distributer != out.distributer) continue;
    for (const Leaf& its : leaves_of(*in.type))
      if (!its.path.empty() && its.path == leaf.path && its.unit == leaf.unit) return Reported::Command{i, its};
  }
  return std::nullopt;
}

RunColumn::Reached reached(std::string title, const Leaf& leaf, const void* value, bool is_true) {
  return {std::move(title), leaf.unit, expect::read_number(leaf, value), is_true};
}

}  // namespace

std::vector<Reported> find_reported(const Graph& graph) {
  std::vector<Reported> all;
  for (std::size_t i = 0; i < graph.communicators.size(); ++i) {
    const Communicator& out = graph.communicators[i];
    if (out.direction != Direction::out || !out.distributer) continue;
    std::vector<Reported> fields;
    for (const Leaf& leaf : leaves_of(*out.type))
      if (!leaf.type->is_deep()) fields.push_back({leaf.path, i, leaf, find_command(graph, out, leaf)});
    if (std::any_of(fields.begin(), fields.end(), [](const Reported& r) { return r.command.has_value(); }))
      all.insert(all.end(), fields.begin(), fields.end());
  }
  return all;
}

RunColumn column_of(const RunState& state, const Report& report, const std::vector<TrueState>& truth,
                    const RunVerdict& verdict) {
  const Graph& graph = state.plan.graph;
  RunColumn column{.digest = report.digest, .fault_count = report.fault_count, .verdict = verdict};
  if (report.stopped) column.stopped = to_text(report.faults.back());
  for (const Reported& r : find_reported(graph)) {
    if (!r.command) continue;
    column.reached.push_back(reached(r.title, r.leaf, state.last[r.communicator], false));
    if (truth.size() != 1) continue;  // of several vehicles nobody knows whose is meant
    const Value& values = truth.front().values;
    for (const Leaf& leaf : leaves_of(*values.type()))
      if (leaf.path == r.leaf.path && leaf.unit == r.leaf.unit)
        column.reached.push_back(reached(r.title, leaf, values.data(), true));
  }
  return column;
}

}  // namespace jarol
