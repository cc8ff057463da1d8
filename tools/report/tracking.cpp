#include "tools/report/tracking.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace jarol::tools {
namespace {

double shown(const Leaf& leaf, double value) { return leaf.unit == "rad" ? value * 180.0 / std::numbers::pi : value; }

}  // namespace

std::string reached_text(const Graph& graph, const std::function<const void*(std::size_t)>& last_value,
                         const std::vector<TrueState>& true_states) {
  const auto number = [&](const Leaf& leaf, const void* value) {
    const auto* bytes = static_cast<const std::byte*>(value) + leaf.offset;
    return leaf.type->kind == Kind::floating ? shown(leaf, read_floating(*leaf.type, bytes))
                                             : static_cast<double>(read_integer(*leaf.type, bytes));
  };
  // of several vehicles nobody knows whose is meant
  const auto true_text = [&](const Reported& r) -> std::string {
    if (true_states.size() != 1) return "";
    const Value& values = true_states.front().values;
    for (const Leaf& leaf : leaves_of(*values.type()))
      if (leaf.path == r.leaf.path && leaf.unit == r.leaf.unit)
        return fmt::format("  {:>10.3f}", number(leaf, values.data()));
    return fmt::format("  {:>10}", "");
  };
  std::string text;
  for (const Reported& r : find_reported(graph)) {
    if (!r.command) continue;
    if (text.empty())
      text = fmt::format("  {:<10}  {:>10}  {:>10}{}\n", "", "commanded", "reached",
                         true_states.size() == 1 ? fmt::format("  {:>10}", "true") : "");
    text += fmt::format(
        "  {:<10}  {:>10.3f}  {:>10.3f}{} {}\n", r.title, number(r.command->leaf, last_value(r.command->communicator)),
        number(r.leaf, last_value(r.communicator)), true_text(r), r.leaf.unit == "rad" ? "deg" : r.leaf.unit);
  }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<TrueState>& true_states) {
  auto json = nlohmann::ordered_json::object();
  for (const TrueState& state : true_states)
    for (const Leaf& leaf : leaves_of(*state.values.type()))
      json[state.distributer][leaf.path] = expect::read_number(leaf, state.values.data());
  return json;
}

}  // namespace jarol::tools
