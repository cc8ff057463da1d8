#include "graph/model/chains.h"

#include <algorithm>

namespace jarol {
namespace {

std::optional<End> find_end(const Graph& graph, const std::string& name) {
  for (std::size_t i = 0; i < graph.tasks.size(); ++i)
    if (graph.tasks[i].name == name) return End{End::Kind::task, i, 0};
  for (std::size_t i = 0; i < graph.communicators.size(); ++i)
    if (graph.communicators[i].name == name) return End{End::Kind::communicator, i, 0};
  return std::nullopt;
}

bool same(const End& a, const End& b) { return a.kind == b.kind && a.index == b.index; }

const std::string& name_of(const Graph& graph, const End& end) {
  return end.kind == End::Kind::task ? graph.tasks[end.index].name : graph.communicators[end.index].name;
}

bool connected(const Graph& graph, const End& from, const End& to) {
  return std::any_of(graph.connections.begin(), graph.connections.end(),
                     [&](const Connection& c) { return same(c.from, from) && same(c.to, to); });
}

std::vector<std::string> readers_of(const Graph& graph, const End& from) {
  std::vector<std::string> names;
  for (const Connection& c : graph.connections)
    if (same(c.from, from)) names.push_back(name_of(graph, c.to));
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

void resolve(const Yaml& path, Chain& chain, const Graph& graph, Problems& problems) {
  const std::string subject = "chain '" + chain.name + "'";
  if (path.kind != Yaml::Kind::sequence || path.children.empty())
    return problems.add(path.where, subject +
                                        " needs a path, a list of tasks and communicators as in [from_dune, "
                                        "depth, to_dune]");
  for (const Yaml& child : path.children) {
    const auto end = child.kind == Yaml::Kind::scalar ? find_end(graph, child.text) : std::nullopt;
    if (!end) {
      std::vector<std::string> names = names_of(graph.tasks);
      for (const Communicator& c : graph.communicators) names.push_back(c.name);
      return problems.add(child.where, subject + " goes through '" + child.text +
                                           "', which is no task or communicator" + did_you_mean(child.text, names));
    }
    if (!chain.path.empty() && !connected(graph, chain.path.back(), *end))
      return problems.add(child.where, subject + " goes from '" + name_of(graph, chain.path.back()) + "' to '" +
                                           child.text + "', but no connection does; '" +
                                           name_of(graph, chain.path.back()) +
                                           "' feeds: " + list_of(readers_of(graph, chain.path.back())));
    chain.path.push_back(*end);
  }
}

}  // namespace

void add_chains(const GraphSpec& spec, Graph& graph, Problems& problems) {
  for (const ChainSpec& s : spec.chains) {
    Chain chain{s.name, s.where, {}, std::nullopt, std::nullopt, std::nullopt};
    if (s.reaction) chain.reaction = s.reaction->value;
    if (s.age) chain.age = s.age->value;
    if (s.crossover) chain.crossover = s.crossover->value;
    if (s.path) resolve(s.path->value, chain, graph, problems);
    graph.chains.push_back(std::move(chain));
  }
  std::stable_sort(graph.chains.begin(), graph.chains.end(),
                   [](const Chain& a, const Chain& b) { return a.name < b.name; });
}

}  // namespace jarol
