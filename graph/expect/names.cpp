#include "graph/expect/names.h"

#include <algorithm>

#include "graph/text/article.h"

namespace jarol::expect {
namespace {

bool is_number(const Type& type) { return !type.is_deep(); }

// A published value by its whole name: "task.output" or "communicator".
struct Published {
  std::string name;
  End end;
  const Type* type = nullptr;
};

std::vector<Published> all_published(const Graph& graph) {
  std::vector<Published> all;
  for (std::size_t t = 0; t < graph.tasks.size(); ++t) {
    if (graph.tasks[t].task_class == nullptr) continue;
    const auto& fields = graph.tasks[t].task_class->out->fields;
    for (std::size_t f = 0; f < fields.size(); ++f)
      all.push_back({graph.tasks[t].name + "." + fields[f].name, {End::Kind::task, t, f}, fields[f].type});
  }
  for (std::size_t c = 0; c < graph.communicators.size(); ++c)
    if (graph.communicators[c].type != nullptr)
      all.push_back({graph.communicators[c].name, {End::Kind::communicator, c, 0}, graph.communicators[c].type});
  return all;
}

// The unit of a whole output stands with the task's field.
std::string unit_of(const Graph& graph, const Published& published, const Leaf& leaf) {
  if (!leaf.unit.empty() || published.end.kind != End::Kind::task) return leaf.unit;
  const TypeField& field = graph.tasks[published.end.index].task_class->out->fields[published.end.field];
  return leaf.path.empty() || field.type->kind == Kind::array ? field.unit : "";
}

Signal signal_of(const Graph& graph, const Published& published, Leaf leaf) {
  Signal signal;
  signal.name = published.name + (leaf.path.empty() ? "" : "." + leaf.path);
  signal.published = published.end;
  leaf.unit = leaf.type->kind == Kind::duration ? "s" : unit_of(graph, published, leaf);
  signal.leaf = std::move(leaf);
  return signal;
}

std::vector<std::string> paths_of(const std::vector<Leaf>& leaves) {
  std::vector<std::string> paths;
  for (const Leaf& leaf : leaves)
    if (is_number(*leaf.type)) paths.push_back(leaf.path);
  return paths;
}

// What is wrong with the path of a field of that type.
std::string wrong_path(const std::string& name, const Type& type, const std::string& path) {
  const auto leaves = leaves_of(type);
  const auto paths = paths_of(leaves);
  for (const Leaf& leaf : leaves)
    if (leaf.path == path)
      return "'" + name + (path.empty() ? "" : "." + path) + "' is " + with_article(leaf.type->name) +
             ", which can't be judged; name a number, a truth value or a choice";
  const bool inner = std::any_of(leaves.begin(), leaves.end(),
                                 [&](const Leaf& leaf) { return path.empty() || leaf.path.starts_with(path + "."); });
  if (inner)
    return "'" + name + (path.empty() ? "" : "." + path) +
           "' is no single number; name one of its fields: " + list_of(paths);
  return "'" + name + "' (" + std::string(type.name) + ") has no field '" + path + "'" + did_you_mean(path, paths) +
         "; it has: " + list_of(paths);
}

// All fields whose whole name ends with that, after a dot.
std::vector<Signal> find_by_end(const Graph& graph, const std::vector<Published>& all, const std::string& name) {
  std::vector<Signal> found;
  for (const Published& published : all)
    for (Leaf& leaf : leaves_of(*published.type))
      if (is_number(*leaf.type) && (published.name + "." + leaf.path).ends_with("." + name))
        found.push_back(signal_of(graph, published, std::move(leaf)));
      else if (is_number(*leaf.type) && leaf.path.empty() && published.name.ends_with("." + name))
        found.push_back(signal_of(graph, published, std::move(leaf)));
  return found;
}

std::vector<std::string> outputs_of(const Task& task) {
  std::vector<std::string> names;
  for (const TypeField& field : task.task_class->out->fields) names.push_back(field.name);
  return names;
}

}  // namespace

Found find_published(const Graph& graph, const std::string& name) {
  const auto all = all_published(graph);
  for (const Published& published : all) {
    if (name != published.name && !name.starts_with(published.name + ".")) continue;
    const std::string path = name == published.name ? "" : name.substr(published.name.size() + 1);
    for (Leaf& leaf : leaves_of(*published.type))
      if (leaf.path == path && is_number(*leaf.type)) return {signal_of(graph, published, std::move(leaf)), "", ""};
    return {std::nullopt, wrong_path(published.name, *published.type, path), ""};
  }
  const std::string first = name.substr(0, name.find('.'));
  for (const Task& task : graph.tasks) {
    if (task.name != first) continue;
    if (task.task_class == nullptr) return {};
    const std::string rest = name.size() > first.size() ? name.substr(first.size() + 1) : "";
    const std::string output = rest.substr(0, rest.find('.'));
    if (output.empty())
      return {std::nullopt, "'" + name + "' is a task; name one of its outputs: " + list_of(outputs_of(task)), ""};
    return {std::nullopt,
            "task '" + first + "' (" + task.task_class->name + ") has no output '" + output + "'" +
                did_you_mean(output, outputs_of(task)) + "; it has: " + list_of(outputs_of(task)),
            ""};
  }
  for (const Communicator& communicator : graph.communicators)
    if (communicator.name == first && communicator.type == nullptr) return {};
  std::vector<Signal> short_for = find_by_end(graph, all, name);
  if (short_for.size() == 1) return {std::move(short_for.front()), "", ""};
  if (!short_for.empty())
    return {std::nullopt, "'" + name + "' may be any of these; write one of: " + list_of(names_of(short_for)), ""};
  std::vector<std::string> names = names_of(graph.tasks);
  for (const Communicator& communicator : graph.communicators) names.push_back(communicator.name);
  return {std::nullopt,
          "there is no task or communicator '" + first + "'" + did_you_mean(first, names) +
              "; there are: " + list_of(names),
          ""};
}

Found find_true(const Graph& graph, const std::vector<TrueValues>& vehicles, const std::string& field,
                const std::string& distributer) {
  const auto at = std::find_if(graph.distributers.begin(), graph.distributers.end(),
                               [&](const Distributer& d) { return d.name == distributer; });
  const auto names = names_of(graph.distributers);
  if (at == graph.distributers.end())
    return {std::nullopt,
            "there is no distributer '" + distributer + "'" + did_you_mean(distributer, names) +
                "; there are: " + list_of(names),
            ""};
  const auto index = static_cast<std::size_t>(at - graph.distributers.begin());
  const TrueValues& vehicle = vehicles[index];
  Signal signal;
  signal.name = field + " of " + distributer;
  signal.distributer = index;
  if (vehicle.where == TrueValues::Where::nowhere)
    return {std::nullopt, "distributer '" + distributer + "' has no vehicle, and so no true values", ""};
  if (vehicle.where == TrueValues::Where::elsewhere)
    return {std::move(signal), "", "the vehicle of '" + distributer + "' is not simulated in this process"};
  const auto leaves = leaves_of(*vehicle.type);
  for (const Leaf& leaf : leaves)
    if (leaf.path == field) {
      signal.leaf = leaf;
      return {std::move(signal), "", ""};
    }
  return {std::nullopt,
          "the vehicle of '" + distributer + "' has no true value '" + field + "'" +
              did_you_mean(field, paths_of(leaves)) + "; it has: " + list_of(paths_of(leaves)),
          ""};
}

}  // namespace jarol::expect
