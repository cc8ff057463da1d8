#include "tools/commands/run/panels.h"

#include <fnmatch.h>

#include <algorithm>
#include <iostream>
#include <sstream>

#include "graph/language/load.h"
#include "graph/language/problems.h"
#include "graph/text/errors.h"
#include "tools/report/tracking.h"

namespace jarol::tools {
namespace {

Panel panel_of(const Output& output, std::uint32_t index, const Leaf& leaf) {
  return {leaf.path.empty() ? output.name : output.name + "." + leaf.path, leaf.unit, index, leaf, std::nullopt};
}

// A panel for each number that is published, in order of name.
std::vector<Panel> all_panels(const std::vector<Output>& outputs) {
  std::vector<Panel> panels;
  for (std::uint32_t i = 0; i < outputs.size(); ++i)
    for (const Leaf& leaf : leaves_of(*outputs[i].type))
      if (!leaf.type->is_deep()) panels.push_back(panel_of(outputs[i], i, leaf));
  return panels;
}

std::uint32_t output_of(const Graph& graph, const std::vector<Output>& outputs, std::size_t communicator) {
  const std::string& name = graph.communicators[communicator].name;
  const auto at = std::lower_bound(outputs.begin(), outputs.end(), name,
                                   [](const Output& o, const std::string& n) { return o.name < n; });
  return static_cast<std::uint32_t>(at - outputs.begin());
}

// The only vehicle of which something is known: of several nobody knows whose is meant.
struct TrueOutput {
  std::uint32_t output = 0;
  std::vector<Leaf> leaves{};

  const Leaf* find(const std::string& path, const std::string& unit) const {
    const auto at = std::find_if(leaves.begin(), leaves.end(),
                                 [&](const Leaf& leaf) { return leaf.path == path && leaf.unit == unit; });
    return at == leaves.end() ? nullptr : &*at;
  }
};

TrueOutput true_output(const std::vector<Output>& outputs, const std::vector<const Type*>& truths) {
  TrueOutput found;
  if (std::count(truths.begin(), truths.end(), nullptr) + 1 != static_cast<std::ptrdiff_t>(truths.size())) return found;
  for (std::size_t i = 0; i < truths.size(); ++i)
    if (truths[i] != nullptr) found = {static_cast<std::uint32_t>(outputs.size() + i), leaves_of(*truths[i])};
  return found;
}

std::vector<Panel> reported_panels(const Graph& graph, const std::vector<Output>& outputs, const TrueOutput& truth) {
  constexpr std::size_t max_panels = 8;
  std::vector<Panel> panels;
  for (const Reported& r : find_reported(graph)) {
    if (panels.size() == max_panels) break;
    Panel panel{r.title, r.leaf.unit, output_of(graph, outputs, r.communicator), r.leaf, std::nullopt};
    if (r.command) panel.commanded = std::pair(output_of(graph, outputs, r.command->communicator), r.command->leaf);
    if (const Leaf* leaf = truth.find(r.leaf.path, r.leaf.unit)) panel.truth = std::pair(truth.output, *leaf);
    panels.push_back(std::move(panel));
  }
  return panels;
}

// A panel for each member of what goes to a vehicle, with all its elements.
std::vector<Panel> actuator_panels(const Graph& graph, const std::vector<Output>& outputs) {
  constexpr std::size_t max_panels = 4;
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < graph.communicators.size(); ++i) {
    const Communicator& out = graph.communicators[i];
    if (out.direction != Direction::out || !out.distributer) continue;
    if (!graph.distributers[*out.distributer].distributer_class->is_vehicle) continue;
    std::string member;
    for (const Leaf& leaf : leaves_of(*out.type)) {
      if (leaf.type->is_deep()) continue;
      const std::string its = leaf.path.substr(0, leaf.path.find('.'));
      const std::uint32_t output = output_of(graph, outputs, i);
      if (!panels.empty() && panels.back().output == output && its == member && leaf.unit == panels.back().unit) {
        panels.back().more.emplace_back(output, leaf);
        continue;
      }
      if (panels.size() == max_panels) return panels;
      member = its;
      panels.push_back({its.empty() ? out.name : out.name + "." + its, leaf.unit, output, leaf, std::nullopt});
    }
  }
  return panels;
}

const Leaf* find_metres(const std::vector<Leaf>& leaves, std::string_view path) {
  const auto at = std::find_if(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
    return leaf.path == path && leaf.unit == "m" && leaf.type->kind == Kind::floating;
  });
  return at == leaves.end() ? nullptr : &*at;
}

std::optional<PathSource> path_in(std::uint32_t output, const std::vector<Leaf>& leaves) {
  const Leaf *north = find_metres(leaves, "x"), *east = find_metres(leaves, "y");
  if (north == nullptr || east == nullptr) return std::nullopt;
  return PathSource{output, *north, *east};
}

// As an operator gets it.
std::optional<PathSource> reported_path(const Graph& graph, const std::vector<Output>& outputs) {
  for (std::size_t i = 0; i < graph.communicators.size(); ++i) {
    const Communicator& out = graph.communicators[i];
    if (out.direction != Direction::out || !out.distributer) continue;
    if (graph.distributers[*out.distributer].distributer_class->is_vehicle) continue;
    if (const auto path = path_in(output_of(graph, outputs, i), leaves_of(*out.type))) return path;
  }
  return std::nullopt;
}

}  // namespace

Picture picture_of(const Graph& graph, const std::vector<Output>& outputs, const std::vector<const Type*>& truths) {
  constexpr std::size_t max_panels = 8;
  const TrueOutput truth = true_output(outputs, truths);
  Picture picture{reported_panels(graph, outputs, truth)};
  if (picture.panels.empty()) {
    std::cerr
        << "note: no 'out' communicator of an operator reports what one of its 'in' communicators commands, so the "
           "picture shows what is published first; name fields by --signals\n";
    picture.panels = all_panels(outputs);
    if (picture.panels.size() > max_panels) picture.panels.resize(max_panels);
    return picture;
  }
  for (Panel& panel : actuator_panels(graph, outputs)) picture.panels.push_back(std::move(panel));
  picture.extras.path = reported_path(graph, outputs);
  if (!truth.leaves.empty()) picture.extras.true_path = path_in(truth.output, truth.leaves);
  return picture;
}

std::vector<Panel> panels_named(const std::string& patterns, const std::vector<Output>& outputs) {
  constexpr std::size_t max_panels = 40;
  const std::vector<Panel> all = all_panels(outputs);
  std::vector<bool> taken(all.size());
  std::vector<Panel> panels;
  std::istringstream words(patterns);
  for (std::string word; std::getline(words, word, ',');) {
    if (word.empty())
      throw InputError("--signals: '" + patterns + "' has an empty name; write them as in depth.*,fins.*");
    bool fits = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (fnmatch(word.c_str(), all[i].title.c_str(), 0) != 0) continue;
      fits = true;
      if (!taken[i]) panels.push_back(all[i]);
      taken[i] = true;
    }
    if (fits) continue;
    std::vector<std::string> names;
    for (const Panel& panel : all) names.push_back(panel.title);
    throw InputError("--signals: nothing that is published has the name '" + word + "'" + did_you_mean(word, names) +
                     "; there are: " + list_of(names));
  }
  if (panels.size() > max_panels)
    throw InputError("--signals: '" + patterns + "' names " + std::to_string(panels.size()) +
                     " fields, more than the " + std::to_string(max_panels) +
                     " that a picture has room for; name fewer");
  return panels;
}

std::string note_of(const Overrides& overrides, std::uint64_t seed) {
  std::string note = overrides.profile.empty() ? "" : "profile " + overrides.profile + ", ";
  note += "seed " + std::to_string(seed);
  for (const std::string& set : overrides.set) note += ", " + set;
  constexpr std::size_t max_length = 100;
  if (note.size() > max_length) note = note.substr(0, max_length) + "...";
  return note;
}

}  // namespace jarol::tools
