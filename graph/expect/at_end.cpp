#include "graph/expect/at_end.h"

#include <algorithm>

#include "graph/expect/parse.h"
#include "graph/values/bind.h"

namespace jarol::expect {
namespace {

const std::string at_end_key = "'at_end'";

// The paths of a value that YAML which fits it states: those of its scalars.
void add_stated(const Yaml& yaml, const std::string& path, std::vector<std::string>& paths) {
  if (yaml.kind == Yaml::Kind::scalar) return paths.push_back(path);
  for (std::size_t i = 0; i < yaml.children.size(); ++i) {
    const std::string name = yaml.kind == Yaml::Kind::mapping ? yaml.children[i].key : std::to_string(i);
    add_stated(yaml.children[i], path.empty() ? name : path + "." + name, paths);
  }
}

std::vector<std::string> commandable(const Graph& graph) {
  std::vector<std::string> names;
  for (const Communicator& c : graph.communicators)
    if (c.direction == Direction::in && c.distributer && !c.type->is_deep() &&
        graph.distributers[*c.distributer].distributer_class != nullptr &&
        !graph.distributers[*c.distributer].distributer_class->is_vehicle)
      names.push_back(c.name);
  return names;
}

// Why that communicator can't be commanded; empty: it can.
std::string wrong_with(const Graph& graph, const Communicator& c) {
  if (c.direction == Direction::out) return "is an 'out'";
  if (!c.distributer) return "has no channel";
  if (graph.distributers[*c.distributer].distributer_class->is_vehicle) return "is what a vehicle reports";
  return c.type->is_deep() ? "carries a value of changing size" : "";
}

void read_command(const Yaml& yaml, Graph& graph, Problems& problems) {
  const auto found = std::find_if(graph.communicators.begin(), graph.communicators.end(),
                                  [&](const Communicator& c) { return c.name == yaml.key; });
  const std::vector<std::string> names = commandable(graph);
  const std::string choice =
      "; command what comes from an operator" + (names.empty() ? ", of which there is none" : ": " + list_of(names));
  if (found == graph.communicators.end())
    return problems.add(yaml.key_where, at_end_key + " commands '" + yaml.key + "', and there is no such communicator" +
                                            did_you_mean(yaml.key, names) + choice);
  if (found->type == nullptr) return;  // reported
  if (const std::string wrong = wrong_with(graph, *found); !wrong.empty())
    return problems.add(yaml.key_where, at_end_key + " commands '" + yaml.key + "', which " + wrong + choice);
  EndCommand command{static_cast<std::size_t>(found - graph.communicators.begin()), jarol::Value(*found->type), {}};
  bind_value(yaml, *found->type, "", command.value.data(), at_end_key + " communicator '" + yaml.key + "'", problems);
  std::vector<std::string> stated;
  add_stated(yaml, "", stated);
  for (const Leaf& leaf : leaves_of(*found->type))
    if (std::find(stated.begin(), stated.end(), leaf.path) != stated.end()) command.stated.push_back(leaf);
  if (stated.empty())
    problems.add(yaml.where, at_end_key + " commands nothing of '" + yaml.key + "'; state a field of it");
  graph.at_end->commands.push_back(std::move(command));
}

}  // namespace

void add_at_end(const GraphSpec& spec, Graph& graph, Problems& problems) {
  if (!spec.at_end) return;
  graph.at_end.emplace();
  if (spec.at_end->longest) graph.at_end->longest = spec.at_end->longest->value;
  if (const auto& command = spec.at_end->command) {
    if (command->value.children.empty())
      problems.add(command->where, at_end_key +
                                       " commands nothing; name a communicator and what it reads as, as in {pilot: "
                                       "{land: true}}");
    for (const Yaml& each : command->value.children) read_command(each, graph, problems);
  }
  if (!spec.at_end->until) return;
  auto until = parse_state(spec.at_end->until->value, at_end_key + " key 'until'", graph, problems);
  if (until) graph.at_end->until = std::move(*until);
}

}  // namespace jarol::expect
