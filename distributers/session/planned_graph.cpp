#include "distributers/session/planned_graph.h"

#include <algorithm>
#include <map>
#include <utility>

#include "distributers/distributers.h"
#include "graph/language/override.h"
#include "graph/model/parameters.h"

namespace jarol {
namespace {

// "tasks", "depth", "parameters.kp" of "tasks.depth.parameters.kp=0.3"
struct Parts {
  std::string section, name, rest;
};

Parts parts_of(const std::string& change) {
  const std::string path = change.substr(0, change.find('='));
  const std::size_t first = path.find('.');
  if (first == std::string::npos) return {path, "", ""};
  const std::size_t second = path.find('.', first + 1);
  if (second == std::string::npos) return {path.substr(0, first), path.substr(first + 1), ""};
  return {path.substr(0, first), path.substr(first + 1, second - first - 1), path.substr(second + 1)};
}

Yaml mapping(std::string key, Location where, std::vector<Yaml> children) {
  Yaml made;
  made.kind = Yaml::Kind::mapping;
  made.key = std::move(key);
  made.key_where = made.where = std::move(where);
  made.children = std::move(children);
  return made;
}

void add(Yaml& to, const std::string& key, const Maybe<Yaml>& value) {
  if (!value) return;
  to.children.push_back(value->value);
  to.children.back().key = key;
}

// The changes whose names stand after that section, by name, each name's in their order.
std::map<std::string, std::vector<std::string>> changes_of(const std::vector<std::string>& set,
                                                           const std::string& section) {
  std::map<std::string, std::vector<std::string>> changes;
  for (const std::string& change : set)
    if (const Parts parts = parts_of(change); parts.section == section) changes[parts.name].push_back(change);
  return changes;
}

// An entry of a section as the file has it, changed; null: that was wrong.
Yaml changed_entry(const std::string& section, Yaml entry, const std::vector<std::string>& changes,
                   Problems& problems) {
  const Location where = entry.where;
  Yaml root = mapping("", where, {});
  root.children.push_back(mapping(section, where, {}));
  root.children[0].children.push_back(std::move(entry));
  for (const std::string& change : changes) apply_set(root, change, problems);
  return std::move(root.children[0].children[0]);
}

// What a path says that names no entry.
template <class Entry>
void report_unknown(const std::string& section, const std::vector<Entry>& entries, const std::string& change,
                    Problems& problems) {
  Yaml root = mapping("", {}, {});
  root.children.push_back(mapping(section, {}, {}));
  for (const Entry& entry : entries) root.children[0].children.push_back(mapping(entry.name, {}, {}));
  apply_set(root, change, problems);
}

template <class Entry>
const Entry* find(const std::vector<Entry>& entries, const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

PlannedGraph::PlannedGraph(const std::shared_ptr<const Source>& source, const distributers::Registries& known,
                           const Overrides& overrides, const NoteSink& note)
    : loaded_(load_graph(source, known, overrides, 0, note)), plan_(*loaded_.graph) {
  loaded_.systems.clear();
}

bool PlannedGraph::is_of_run(const std::string& path) {
  const Parts parts = parts_of(path);
  if (parts.section == "tasks") return parts.rest.starts_with("parameters.");
  if (parts.section != "distributers") return false;
  return parts.rest.starts_with("parameters.") || parts.rest.starts_with("link.parameters.");
}

RunStart PlannedGraph::start(const std::vector<std::string>& set, std::uint64_t seed) const {
  RunStart start;
  Problems problems;
  change_tasks(set, start, problems);
  const std::vector<Distributer> distributers = change_distributers(set, problems);
  if (problems.empty())
    start.systems = distributers::make_external_systems(graph(), distributers, *loaded_.known, seed, problems);
  problems.throw_if_any();
  return start;
}

void PlannedGraph::change_tasks(const std::vector<std::string>& set, RunStart& start, Problems& problems) const {
  for (const auto& [name, changes] : changes_of(set, "tasks")) {
    const TaskSpec* spec = find(loaded_.spec.tasks, name);
    if (spec == nullptr) {
      report_unknown("tasks", loaded_.spec.tasks, changes[0], problems);
      continue;
    }
    const Task* task = find(graph().tasks, name);
    Yaml entry = mapping(name, spec->where, {});
    add(entry, "parameters", spec->parameters);
    entry = changed_entry("tasks", std::move(entry), changes, problems);
    start.parameters.push_back({static_cast<std::size_t>(task - graph().tasks.data()),
                                read_parameters(name, *task->task_class, entry.find("parameters"), problems)});
  }
}

std::vector<Distributer> PlannedGraph::change_distributers(const std::vector<std::string>& set,
                                                           Problems& problems) const {
  std::vector<Distributer> distributers = graph().distributers;
  for (const auto& [name, changes] : changes_of(set, "distributers")) {
    const DistributerSpec* spec = find(loaded_.spec.distributers, name);
    if (spec == nullptr) {
      report_unknown("distributers", loaded_.spec.distributers, changes[0], problems);
      continue;
    }
    Distributer& of =
        distributers[static_cast<std::size_t>(find(graph().distributers, name) - graph().distributers.data())];
    Yaml entry = mapping(name, spec->where, {});
    add(entry, "link", spec->link);
    add(entry, "parameters", spec->parameters);
    entry = changed_entry("distributers", std::move(entry), changes, problems);
    if (const Yaml* link = entry.find("link")) of.link = *link;
    of.parameters = read_parameters(name, *of.distributer_class, entry.find("parameters"), problems);
  }
  return distributers;
}

}  // namespace jarol
