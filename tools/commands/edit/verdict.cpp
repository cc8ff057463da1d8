#include "tools/commands/edit/verdict.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "distributers/session/checked_graph.h"
#include "graph/language/override.h"
#include "graph/plugins/plugins.h"
#include "tools/commands/check/check_report.h"
#include "tools/commands/edit/spec_drawing.h"
#include "tools/commands/run/known_with.h"
#include "tools/drawing/graph/drawing_json.h"
#include "tools/library/built_in.h"
#include "tools/report/failure.h"

namespace jarol::tools::edit {
namespace {

using Json = nlohmann::ordered_json;

// More than these nobody can read, and Graphviz takes long.
constexpr std::size_t max_drawn = 400;

Json place_json(const Location& where, const std::string& text) {
  return {
      {"file", where.source ? where.source->name : ""}, {"line", where.line}, {"column", where.column}, {"text", text}};
}

Json problems_json(const std::exception_ptr& error) {
  const Failure failure = failure_of(error);
  auto problems = Json::array();
  for (const Problem& problem : failure.problems) {
    Json one = place_json(problem.where, problem.text);
    for (const Note& note : problem.notes) one["notes"].push_back(place_json(note.where, note.text));
    problems.push_back(std::move(one));
  }
  // as where memory ran out
  if (problems.empty()) problems.push_back(place_json({}, failure.text));
  return problems;
}

// As far as it can be read.
GraphText text_of(const EditedText& edited) {
  Problems problems;
  try {
    return read_text(edited.source, edited.overrides, problems);
  } catch (const SpecError&) { return {}; }
}

// What it says, as far as it can be read.
GraphSpec spec_of(const GraphText& text, const Registry& known) {
  Problems problems;
  try {
    return read_spec(text, known.grammars(), known.is_complete(), problems);
  } catch (const SpecError&) { return {}; }
}

// With what plugins bring; one that can't be loaded brings nothing.
distributers::Registries known_to(const GraphText& text) {
  std::vector<std::string> paths;
  for (const auto& plugin : text.plugins) paths.push_back(plugin_path(text.where, plugin.value));
  try {
    return known_with(paths);
  } catch (const std::exception&) { return known_with({}); }
}

}  // namespace

std::vector<std::string> plugins_of(const std::shared_ptr<const Source>& source) {
  std::vector<std::string> plugins;
  for (const auto& plugin : text_of({source, {}}).plugins) plugins.push_back(plugin.value);
  return plugins;
}

void require_profile(const std::shared_ptr<const Source>& source, const std::string& profile) {
  if (profile.empty()) return;
  GraphText text = text_of({source, {}});
  const Yaml* const profiles = text.readable ? text.tree.find("profiles") : nullptr;
  if (!text.readable || (profiles != nullptr && profiles->find(profile) != nullptr)) return;
  Problems problems;
  apply_profile(text.tree, profile, problems);
  problems.throw_if_any();
}

std::string refused_plugins(const Source& text, const std::vector<std::string>& allowed) {
  for (const std::string& plugin : plugins_of(std::make_shared<Source>(text)))
    if (std::find(allowed.begin(), allowed.end(), plugin) == allowed.end())
      return "the editor loads those that the file names; save it, and start jarol edit again";
  return "";
}

Json judge(const EditedText& text) {
  try {
    const CheckedGraph checked =
        check_graph(text.source, built_in(), {.overrides = text.overrides, .remedies = false, .note = note_once});
    const CheckReport report(text.source->name, checked.found);
    return {{"problems", Json::array()}, {"check", to_json(report)}, {"report", to_text(report)}};
  } catch (...) { return {{"problems", problems_json(std::current_exception())}}; }
}

Json draw(const EditedText& text) {
  const GraphText words = text_of(text);
  const Registry known = words.plugins.empty() ? built_in().graph : known_to(words).graph;
  const GraphSpec spec = spec_of(words, known);
  auto connections = Json::array();
  const auto end_json = [](const EndSpec& end) { return end.name + (end.field.empty() ? "" : "." + end.field); };
  for (const ConnectionSpec& c : spec.connections)
    connections.push_back({{"from", end_json(c.from)}, {"to", end_json(c.to)}});
  Json json{{"connections", std::move(connections)}};
  const std::size_t parts = spec.tasks.size() + spec.communicators.size() + spec.distributers.size();
  if (parts > max_drawn) {
    json["why"] =
        "a graph of " + std::to_string(parts) + " parts is not drawn; up to " + std::to_string(max_drawn) + " are";
    return json;
  }
  try {
    json["drawing"] = to_json(lay_out(spec, known));
  } catch (const std::runtime_error& failed) { json["why"] = failed.what(); }
  return json;
}

Json suggest(const EditedText& text) {
  auto list = Json::array();
  try {
    for (const analysis::Remedy& remedy :
         check_graph(text.source, built_in(), {.overrides = text.overrides, .note = note_once}).remedies)
      list.push_back({{"text", remedy.text}, {"set", remedy.set}});
  } catch (const std::exception&) {
    // what does not load has problems instead
  }
  return list;
}

}  // namespace jarol::tools::edit
