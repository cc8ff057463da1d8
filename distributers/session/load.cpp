#include "distributers/session/load.h"

#include <fnmatch.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <span>
#include <utility>

#include "distributers/distributers.h"
#include "graph/campaign/read.h"
#include "graph/expect/at_end.h"
#include "graph/expect/parse.h"
#include "graph/language/source_set.h"
#include "graph/model/build.h"
#include "graph/plugins/isolated.h"
#include "graph/plugins/plugins.h"
#include "graph/text/escape.h"

namespace jarol {
namespace {

// Of true values that were recorded; null: there are none, or no vehicle that is known here has such.
const Type* recorded_type(const Loaded& loaded, const std::string& distributer, const RecordingHeader* recorded) {
  if (recorded == nullptr) return nullptr;
  for (const RecordingHeader::Truth& truth : recorded->truths)
    for (const vehicles::VehicleClass& vehicle : loaded.known->vehicles.entries())
      if (truth.distributer == distributer && vehicle.truth != nullptr &&
          signature_of(*vehicle.truth) == truth.signature)
        return vehicle.truth;
  return nullptr;
}

// Null: it has none, or of a type that is not known.
const distributers::LinkType* link_of(const Distributer& distributer, const NamedList<distributers::LinkType>& known) {
  const Yaml* const type = distributer.link.kind == Yaml::Kind::mapping ? distributer.link.find("type") : nullptr;
  return type == nullptr ? nullptr : known.find(type->text);
}

// Where the vehicle of each distributer is.
std::vector<expect::TrueValues> true_values_of(const Loaded& loaded, const RecordingHeader* recorded) {
  using Where = expect::TrueValues::Where;
  std::vector<expect::TrueValues> all;
  for (std::size_t i = 0; i < loaded.graph->distributers.size(); ++i) {
    const Distributer& distributer = loaded.graph->distributers[i];
    const distributers::LinkType* const link = link_of(distributer, loaded.known->links);
    const Type* type = i < loaded.systems.size() && loaded.systems[i]
                           ? loaded.systems[i]->true_type()
                           : recorded_type(loaded, distributer.name, recorded);
    const bool is_vehicle = distributer.distributer_class == nullptr || distributer.distributer_class->is_vehicle;
    all.push_back({type != nullptr                                              ? Where::here
                   : !is_vehicle || (link != nullptr && link->without_messages) ? Where::nowhere
                                                                                : Where::elsewhere,
                   type});
  }
  return all;
}

// Of the missions, then of the graph; where that expects nothing of neither.
std::vector<expect::Condition> expectations_of(const Loaded& loaded,
                                               const std::vector<std::unique_ptr<ExternalSystem>>& missions,
                                               Problems& problems) {
  const Maybe<Yaml>& list = loaded.spec.expect;
  std::vector<expect::Condition> all;
  if (expect::expects_nothing(list)) return all;
  for (const std::unique_ptr<ExternalSystem>& mission : missions)
    for (const Yaml& text : mission ? mission->expectations() : std::span<const Yaml>{})
      if (auto condition = expect::parse_condition(text, *loaded.graph, loaded.true_values, problems))
        all.push_back(std::move(*condition));
  std::vector<expect::Condition> own = expect::read_expectations(list, *loaded.graph, loaded.true_values, problems);
  all.insert(all.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
  return all;
}

// What depends on where the vehicles are.
void add_conditions(Loaded& loaded, Problems& problems, const std::vector<std::unique_ptr<ExternalSystem>>& missions,
                    const RecordingHeader* recorded = nullptr) {
  loaded.true_values = true_values_of(loaded, recorded);
  loaded.graph->expectations = expectations_of(loaded, missions, problems);
  loaded.campaign = campaign::read_campaign(loaded.spec.campaign, *loaded.graph, loaded.true_values, problems);
  problems.throw_if_any();
}

// What is loaded runs as the user: who it is stands there first.
std::unique_ptr<distributers::Registries> with_plugins_of(const GraphText& text, const distributers::Registries& known,
                                                          const NoteSink& note, Problems& problems) {
  if (!known.plugins.empty()) return std::make_unique<distributers::Registries>(known);
  for (const Located<std::string>& plugin : text.plugins) {
    const std::string path = plugin_path(text.where, plugin.value);
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) note("loads plugin '" + printable(path) + "'");
  }
  PluginParts parts{known.graph, {}};
  std::vector<LoadedPlugin> plugins = load_plugins(
      text, parts, [&](const Extension& extension) { return distributers::has(known, extension); }, problems);
  auto made = std::make_unique<distributers::Registries>(distributers::with_plugins(known, std::move(parts)));
  made->plugins = std::move(plugins);
  return made;
}

Loaded load(const GraphText& text, const distributers::Registries& known, const NoteSink& note, Problems& problems) {
  Loaded loaded;
  loaded.known = with_plugins_of(text, known, note, problems);
  const Registry& registry = loaded.known->graph;
  const GraphSpec& spec = loaded.spec = read_spec(text, registry.grammars(), registry.is_complete(), problems);
  // where no file is read any more, what now stands at its place may be another plugin
  if (SourceSet::closed().empty())
    for (const LoadedPlugin& plugin : loaded.known->plugins)
      check_isolation(spec, registry, plugin.types, plugin.path, problems);
  loaded.graph = std::make_unique<Graph>(build_graph(spec, registry, problems));
  expect::add_at_end(spec, *loaded.graph, problems);
  return loaded;
}

// Its instruments with `fitted: false`, by the names of their parameters.
std::string list_unfitted(const Distributer& distributer) {
  std::string names;
  if (distributer.parameters.type() == nullptr) return names;
  for (const TypeField& parameter : distributer.parameters.type()->fields) {
    const TypeField* const fitted = find_field(*parameter.type, "fitted");
    if (fitted == nullptr || fitted->type->kind != Kind::boolean) continue;
    const auto* const data = static_cast<const std::byte*>(distributer.parameters.data());
    if (read_integer(*fitted->type, data + parameter.offset + fitted->offset) == 0)
      names += (names.empty() ? "" : ", ") + parameter.name;
  }
  return names;
}

// The systems of missions alone, which are read for what they expect.
std::vector<std::unique_ptr<ExternalSystem>> missions_of(const Loaded& loaded, Problems& problems) {
  std::vector<Distributer> distributers = loaded.graph->distributers;
  for (Distributer& distributer : distributers) {
    const distributers::LinkType* const link = link_of(distributer, loaded.known->links);
    if (link == nullptr || !link->is_mission) distributer.link = {};
  }
  return distributers::make_external_systems(*loaded.graph, distributers, *loaded.known, 0, problems);
}

}  // namespace

Loaded load_without_systems(const std::shared_ptr<const Source>& source, const distributers::Registries& known,
                            const Overrides& overrides, const NoteSink& note, const RecordingHeader* recorded) {
  Problems problems;
  Loaded loaded = load(read_text(source, overrides, problems), known, note, problems);
  add_conditions(loaded, problems, missions_of(loaded, problems), recorded);
  return loaded;
}

bool fits(const std::string& name, const std::vector<std::string>& patterns) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return fnmatch(pattern.c_str(), name.c_str(), 0) == 0; });
}

Loaded load_graph(const std::shared_ptr<const Source>& source, const distributers::Registries& known,
                  const Overrides& overrides, std::uint64_t seed, const NoteSink& note,
                  const std::vector<std::string>& without_link) {
  Problems problems;
  Loaded loaded = load(read_text(source, overrides, problems), known, note, problems);
  for (Distributer& distributer : loaded.graph->distributers)
    if (fits(distributer.name, without_link)) distributer.link = {};
  loaded.files = {source};
  loaded.systems = distributers::make_external_systems(*loaded.graph, *loaded.known, seed, problems, &loaded.files);
  add_conditions(loaded, problems, loaded.systems);
  for (const Distributer& distributer : loaded.graph->distributers)
    if (const std::string unfitted = list_unfitted(distributer); !unfitted.empty())
      note("distributer '" + distributer.name + "': not fitted, and so not checked: " + unfitted);
  for (std::size_t i = 0; i < loaded.systems.size(); ++i)
    if (const std::string doubt = loaded.systems[i] ? loaded.systems[i]->doubt() : ""; !doubt.empty())
      note("distributer '" + loaded.graph->distributers[i].name + "' " + doubt);
  return loaded;
}

const Distributer* find_in_real_time(const Loaded& loaded) {
  for (std::size_t i = 0; i < loaded.systems.size(); ++i)
    if (loaded.systems[i]->needs_real_clock()) return &loaded.graph->distributers[i];
  return nullptr;
}

}  // namespace jarol
