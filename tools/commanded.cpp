#include "tools/commanded.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

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

double shown(const Leaf& leaf, double value) { return leaf.unit == "rad" ? value * 180.0 / std::numbers::pi : value; }

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

std::string reached_text(const Graph& graph, const std::function<const void*(std::size_t)>& last_value) {
  const auto number = [&](std::size_t communicator, const Leaf& leaf) {
    const auto* value = static_cast<const std::byte*>(last_value(communicator)) + leaf.offset;
    return leaf.type->kind == Kind::floating ? shown(leaf, read_floating(*leaf.type, value))
                                             : static_cast<double>(read_integer(*leaf.type, value));
  };
  std::string text;
  for (const Reported& r : find_reported(graph)) {
    if (!r.command) continue;
    if (text.empty()) text = fmt::format("  {:<10}  {:>10}  {:>10}\n", "", "commanded", "reached");
    text +=
        fmt::format("  {:<10}  {:>10.3f}  {:>10.3f} {}\n", r.title, number(r.command->communicator, r.command->leaf),
                    number(r.communicator, r.leaf), r.leaf.unit == "rad" ? "deg" : r.leaf.unit);
  }
  return text;
}

}  // namespace jarol::tools
