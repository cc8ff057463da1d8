#include "graph/language/override.h"

#include <algorithm>
#include <array>

#include "graph/language/grammar.h"
#include "graph/language/tables.h"

namespace jarol {
namespace {

std::vector<std::string> keys_of(const Yaml& mapping) {
  std::vector<std::string> keys;
  for (const Yaml& child : mapping.children) keys.push_back(child.key);
  return keys;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// Sections whose entries the graph must already have: an override changes a graph, it does not add to it.
bool holds_named_entries(const std::string& section) {
  constexpr std::array<std::string_view, 3> sections{"tasks", "communicators", "distributers"};
  return std::find(sections.begin(), sections.end(), section) != sections.end();
}

void set_source(Yaml& yaml, const std::shared_ptr<const Source>& source) {
  yaml.where.source = source;
  yaml.key_where.source = source;
  for (Yaml& child : yaml.children) set_source(child, source);
}

}  // namespace

void apply_override(Yaml& graph, const std::string& path, const Location& where, Yaml value, Problems& problems) {
  const std::vector<std::string> parts = split(path);
  if (parts[0] == "profiles")
    return problems.add(where, "path '" + path +
                                   "' changes nothing, as profiles are applied before it; set what the profile sets, "
                                   "as in tasks.depth.period=20ms");
  const bool takes_away = value.kind == Yaml::Kind::null;
  Yaml *at = &graph, *above = nullptr;
  std::string done;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    const std::string so_far = done.empty() ? "the graph" : "'" + done + "'";
    if (part.empty()) return problems.add(where, "path '" + path + "' has an empty part; write it as tasks.name.key");
    if (at->kind == Yaml::Kind::null) at->kind = Yaml::Kind::mapping;
    if (at->kind != Yaml::Kind::mapping)
      return problems.add(where, "path '" + path + "' goes through " + so_far + ", which is " +
                                     std::string(kind_name(*at)) + "; only mappings can be entered");
    Yaml* child = find_child(*at, part);
    if (child == nullptr) {
      std::vector<std::string> known = keys_of(*at);
      bool must_exist = takes_away || (i == 1 && holds_named_entries(parts[0]));
      if (i == 0 && !takes_away) {
        known.clear();
        for (const auto& k : graph_keys()) known.push_back(k.name);
        must_exist = std::find(known.begin(), known.end(), part) == known.end();
      }
      if (must_exist)
        return problems.add(where, "path '" + path + "': " + so_far + " has no '" + part + "'" +
                                       (takes_away ? " that could be taken away" : "") + did_you_mean(part, known) +
                                       "; it has: " + list_of(known));
      Yaml made;
      made.kind = Yaml::Kind::mapping;
      made.where = where;
      made.key = part;
      made.key_where = where;
      at->children.push_back(std::move(made));
      child = &at->children.back();
    }
    done += (done.empty() ? "" : ".") + part;
    above = at;
    at = child;
  }
  if (takes_away) {
    above->children.erase(above->children.begin() + (at - above->children.data()));
    return;
  }
  value.key = at->key;
  value.key_where = at->key_where;
  *at = std::move(value);
}

bool read_set(const std::string& argument, const std::string& option, std::string_view example, std::string& path,
              Yaml& value, Problems& problems) {
  const auto source = std::make_shared<Source>(Source{option, argument});
  const std::size_t equals = argument.find('=');
  if (equals == std::string::npos || equals == 0) {
    problems.add({source, 1, 1}, "'" + argument + "' is no override; write path=value, as in " + std::string(example));
    return false;
  }
  const std::size_t begin = argument.find_first_not_of(" \t", equals + 1);
  if (begin == std::string::npos) {
    problems.add({source, 1, static_cast<int>(equals) + 2},
                 "'" + argument + "' gives no value; write path=value, as in " + std::string(example));
    return false;
  }
  // the value alone is read as YAML; blanks in front of it keep its place in the argument
  const auto padded = std::make_shared<Source>(Source{option, std::string(begin, ' ') + argument.substr(begin)});
  Problems of_value;
  value = read_yaml(padded, of_value);
  for (Problem problem : of_value.list()) {
    problem.where.source = source;
    for (Note& note : problem.notes) note.where.source = source;
    problems.add(problem.where, problem.text, problem.notes);
  }
  if (!of_value.empty()) return false;
  set_source(value, source);
  path = argument.substr(0, equals);
  return true;
}

void apply_set(Yaml& graph, const std::string& argument, Problems& problems) {
  std::string path;
  Yaml value;
  if (!read_set(argument, "--set", "tasks.depth.period=20ms", path, value, problems)) return;
  const Location where{value.where.source, 1, 1};
  apply_override(graph, path, where, std::move(value), problems);
}

void apply_profile(Yaml& graph, const std::string& profile, Problems& problems) {
  const Yaml* profiles = graph.find("profiles");
  const std::vector<std::string> names = profiles == nullptr ? std::vector<std::string>{} : keys_of(*profiles);
  const Yaml* found = profiles == nullptr ? nullptr : profiles->find(profile);
  if (found == nullptr)
    return problems.add(graph.where, "there is no profile '" + profile + "'" + did_you_mean(profile, names) +
                                         "; the graph has: " + list_of(names));
  const Yaml overrides = *found;  // a copy: an override may add a key beside 'profiles'
  if (overrides.kind != Yaml::Kind::mapping)
    return problems.add(overrides.where, "profile '" + profile + "' needs a mapping of path to value, not " +
                                             std::string(kind_name(overrides)));
  for (const Yaml& child : overrides.children) apply_override(graph, child.key, child.key_where, child, problems);
}

}  // namespace jarol
