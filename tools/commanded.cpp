#include "tools/commanded.h"

#include <algorithm>

namespace jarol::tools {
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

}  // namespace jarol::tools
