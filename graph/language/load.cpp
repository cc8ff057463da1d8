#include "graph/language/load.h"

#include <algorithm>
#include <exception>
#include <optional>

#include "graph/language/override.h"
#include "graph/language/tables.h"

namespace jarol {

bool is_name(std::string_view text) {
  if (text.empty() || (text[0] >= '0' && text[0] <= '9')) return false;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    if (!letter && !(c >= '0' && c <= '9')) return false;
  }
  return true;
}

namespace {

// Reads a section of named entries, each by the same table.
template <class S>
void read_entries(const Yaml& graph, const std::string& section, const std::string& noun,
                  const std::vector<Key<S>>& keys, std::vector<S>& to, Problems& problems) {
  const Yaml* yaml = graph.find(section);
  if (yaml == nullptr || yaml->kind == Yaml::Kind::null) return;
  if (yaml->kind != Yaml::Kind::mapping)
    return problems.add(yaml->where,
                        "'" + section + "' needs a mapping of names, not " + std::string(kind_name(*yaml)));
  for (const Yaml& child : yaml->children) {
    if (!is_name(child.key))
      problems.add(child.key_where,
                   noun + " name '" + child.key + "' is not a name; use letters, digits and _, no digit first");
    S entry;
    entry.name = child.key;
    entry.where = child.key_where;
    read_keys(child, keys, entry, noun + " '" + child.key + "'", problems);
    to.push_back(std::move(entry));
  }
}

// A section that is one mapping.
template <class S>
void read_section(const Yaml& graph, const std::string& section, const std::vector<Key<S>>& keys, S& to,
                  Problems& problems) {
  const Yaml* yaml = graph.find(section);
  if (yaml != nullptr && yaml->kind != Yaml::Kind::null) read_keys(*yaml, keys, to, "'" + section + "'", problems);
}

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

// "name" or "name.field"; the place is counted within the connection's own text.
bool read_end(std::string_view text, const Yaml& yaml, EndSpec& end) {
  const std::string_view trimmed = trim(text);
  const std::size_t dot = trimmed.find('.');
  const std::string_view name = trimmed.substr(0, dot);
  const std::string_view rest = dot == std::string_view::npos ? std::string_view{} : trimmed.substr(dot + 1);
  if (!is_name(name) || (dot != std::string_view::npos && !is_name(rest))) return false;
  end = {std::string(name), std::string(rest), yaml.where};
  end.where.column += static_cast<int>(trimmed.data() - yaml.text.data()) + (yaml.quoted ? 1 : 0);
  return true;
}

void read_connections(const Yaml& graph, std::vector<ConnectionSpec>& to, Problems& problems) {
  const Yaml* yaml = graph.find("connections");
  if (yaml == nullptr || yaml->kind == Yaml::Kind::null) return;
  if (yaml->kind != Yaml::Kind::sequence)
    return problems.add(yaml->where, "'connections' needs a list of arrows, not " + std::string(kind_name(*yaml)));
  for (const Yaml& child : yaml->children) {
    if (child.kind == Yaml::Kind::mapping) {
      problems.add(child.where, "annotations of connections are not supported yet; write 'from.output -> to.input'");
      continue;
    }
    const std::string_view text = child.text;
    const std::size_t arrow = text.find("->");
    ConnectionSpec connection;
    connection.where = child.where;
    if (child.kind != Yaml::Kind::scalar || arrow == std::string_view::npos ||
        !read_end(text.substr(0, arrow), child, connection.from) ||
        !read_end(text.substr(arrow + 2), child, connection.to)) {
      problems.add(
          child.where,
          "'" + child.text + "' is no connection; write 'from.output -> to.input', a communicator without a dot");
      continue;
    }
    to.push_back(std::move(connection));
  }
}

void read_plugins(const Yaml& graph, const std::string& refused, std::vector<Located<std::string>>& to,
                  Problems& problems) {
  const Yaml* yaml = graph.find("plugins");
  if (yaml == nullptr || yaml->kind == Yaml::Kind::null) return;
  if (yaml->kind != Yaml::Kind::sequence)
    return problems.add(yaml->where,
                        "'plugins' needs a list of shared libraries, not " + std::string(kind_name(*yaml)));
  for (const Yaml& child : yaml->children) {
    if (child.kind != Yaml::Kind::scalar)
      problems.add(child.where, "'plugins' needs paths of shared libraries, not " + std::string(kind_name(child)));
    else if (!refused.empty())
      problems.add(child.where, "plugin '" + child.text + "' is not loaded: " + refused);
    else
      to.push_back({child.text, child.where});
  }
}

// Keys of later versions get a sentence of their own.
void refuse_later_keys(Yaml& graph, Problems& problems) {
  for (const std::string key : {"modes", "predicates"}) {
    const Yaml* found = graph.find(key);
    if (found == nullptr) continue;
    problems.add(found->key_where, "'" + key + "' is not supported yet; leave it out");
    std::erase_if(graph.children, [&](const Yaml& child) { return child.key == key; });
  }
}

// The one that the graph states, or null. Throws SpecError where it is none of these.
const Grammar* find_grammar(const Yaml& graph, const std::vector<Grammar>& grammars, bool all_known,
                            Problems& problems) {
  const Yaml* timing = graph.find("timing");
  const Yaml* stated = timing != nullptr && timing->kind == Yaml::Kind::mapping ? timing->find("grammar") : nullptr;
  if (stated == nullptr || stated->text == language_itself) return nullptr;
  std::vector<std::string> names;
  for (const Grammar& grammar : grammars) names.emplace_back(grammar.name);
  // else it may be one that could not be loaded, and that was reported
  const bool judged = all_known || std::find(names.begin(), names.end(), stated->text) != names.end();
  std::size_t which = 0;
  if (judged && read_choice(*stated, names, which, "'timing' key 'grammar'", problems)) return &grammars[which];
  problems.throw_if_any();
  return nullptr;
}

// Throws SpecError where it can't, as words that stay would be reported as unknown.
void lower(Yaml& graph, const Grammar& grammar, Problems& problems) {
  const Location where = graph.find("timing")->find("grammar")->where;
  const std::size_t before = problems.size();
  try {
    grammar.lower(graph, problems);
  } catch (const std::exception& failed) {
    problems.add(where, "timing grammar '" + std::string(grammar.name) + "' can't read this graph: " + failed.what());
  }
  if (problems.size() > before) problems.throw_if_any();
}

// The smallest part of the graph that an override of that path changes: an entry of a section, a section, or all.
Yaml& part_of(Yaml& graph, std::string_view path) {
  Yaml* part = &graph;
  for (int depth = 0; depth < 2; ++depth) {
    const std::size_t dot = path.find('.');
    const auto below = std::find_if(part->children.begin(), part->children.end(),
                                    [&](const Yaml& child) { return child.key == path.substr(0, dot); });
    if (dot == std::string_view::npos || below == part->children.end()) break;
    part = &*below;
    path.remove_prefix(dot + 1);
  }
  return *part;
}

// What varies is an override like any other, each of the graph as it is.
void require_varied_paths(const Yaml& graph, const CampaignSpec& campaign, Problems& problems) {
  if (!campaign.vary) return;
  Yaml changed = graph;
  for (const Yaml& child : campaign.vary->value.children) {
    if (child.key == "seed") continue;
    Yaml& part = part_of(changed, child.key);
    const Yaml before = part;
    apply_override(changed, child.key, child.key_where, child, problems);
    part = before;
  }
}

}  // namespace

GraphText read_text(const std::shared_ptr<const Source>& source, const Overrides& overrides, Problems& problems) {
  GraphText text{read_yaml(source, problems), {source, 1, 1}, {}, false};
  Yaml& graph = text.tree;
  if (!problems.empty() && graph.kind == Yaml::Kind::null) return text;  // syntax: nothing was read
  if (graph.kind == Yaml::Kind::null) {
    problems.add(graph.where, "there is no graph in it; a graph is a mapping that begins with 'graph: name'");
    return text;
  }
  if (graph.kind != Yaml::Kind::mapping) {
    problems.add(graph.where,
                 "a graph is a mapping that begins with 'graph: name', not " + std::string(kind_name(graph)));
    return text;
  }
  text.readable = true;
  if (!overrides.profile.empty()) apply_profile(graph, overrides.profile, problems);
  for (const std::string& argument : overrides.set) apply_set(graph, argument, problems);
  refuse_later_keys(graph, problems);
  read_plugins(graph, overrides.no_plugins, text.plugins, problems);
  return text;
}

GraphSpec read_spec(const GraphText& text, const std::vector<Grammar>& grammars, bool all_known, Problems& problems) {
  GraphSpec spec;
  spec.where = text.where;
  spec.plugins = text.plugins;
  if (!text.readable) return spec;
  std::optional<Yaml> lowered;
  const Grammar* const grammar = find_grammar(text.tree, grammars, all_known, problems);
  if (grammar != nullptr && grammar->lower != nullptr) lower(lowered.emplace(text.tree), *grammar, problems);
  const Yaml& graph = lowered ? *lowered : text.tree;
  read_keys(graph, graph_keys(), spec, "a graph", problems);
  read_section(graph, "timing", timing_keys(), spec.timing, problems);
  read_section(graph, "platform", platform_keys(), spec.platform, problems);
  if (const Yaml* at_end = graph.find("at_end"); at_end != nullptr && at_end->kind != Yaml::Kind::null)
    read_keys(*at_end, at_end_keys(), spec.at_end.emplace(), "'at_end'", problems);
  if (const Yaml* campaign = graph.find("campaign"); campaign != nullptr && campaign->kind != Yaml::Kind::null) {
    read_keys(*campaign, campaign_keys(), spec.campaign.emplace(), "'campaign'", problems);
    require_varied_paths(text.tree, *spec.campaign, problems);
  }
  read_entries(graph, "distributers", "distributer", distributer_keys(), spec.distributers, problems);
  read_entries(graph, "communicators", "communicator", communicator_keys(), spec.communicators, problems);
  read_entries(graph, "chains", "chain", chain_keys(), spec.chains, problems);
  read_entries(graph, "tasks", "task", task_keys(), spec.tasks, problems);
  read_connections(graph, spec.connections, problems);
  return spec;
}

GraphSpec load_spec(const std::shared_ptr<const Source>& source, const Overrides& overrides, Problems& problems,
                    const std::vector<Grammar>& grammars) {
  return read_spec(read_text(source, overrides, problems), grammars, true, problems);
}

}  // namespace jarol
