#include "tools/run/load_graph.h"

#include <iostream>
#include <set>

#include "distributers/distributers.h"
#include "graph/expect/at_end.h"
#include "graph/expect/parse.h"
#include "graph/model/build.h"
#include "graph/plugins/plugins.h"
#include "graph/text/escape.h"
#include "tasks/tasks.h"
#ifdef JAROL_VEHICLES
#include "vehicles/catalogue.h"
#endif

namespace jarol::tools {
namespace {

Registry make_registry() {
  Registry made;
  tasks::add_tasks(made);
  distributers::add_distributers(made);
  return made;
}

// What is loaded runs as the user: who it is stands there first, once each.
void announce_plugins(const GraphSpec& spec) {
  static std::set<std::string> announced;
  for (const Located<std::string>& plugin : spec.plugins) {
    const std::string path = plugin_path(spec, plugin.value);
    if (announced.insert(path).second) std::cerr << "note: loads plugin '" << printable(path) << "'\n";
  }
}

// Where the vehicle of each distributer is.
std::vector<expect::TrueValues> true_values_of(const Loaded& loaded) {
  using Where = expect::TrueValues::Where;
  std::vector<expect::TrueValues> all;
  for (std::size_t i = 0; i < loaded.graph->distributers.size(); ++i) {
    const Distributer& distributer = loaded.graph->distributers[i];
    const Yaml* link = distributer.link.kind == Yaml::Kind::mapping ? distributer.link.find("type") : nullptr;
    const Type* type = i < loaded.channels.size() && loaded.channels[i] ? loaded.channels[i]->true_type() : nullptr;
    const bool is_vehicle = distributer.distributer_class == nullptr || distributer.distributer_class->is_vehicle;
    all.push_back({type != nullptr                                              ? Where::here
                   : !is_vehicle || (link != nullptr && link->text == "script") ? Where::nowhere
                                                                                : Where::elsewhere,
                   type});
  }
  return all;
}

Loaded load(const GraphSpec& spec, Problems& problems) {
  Loaded loaded;
  loaded.registry = std::make_unique<Registry>(registry());
  announce_plugins(spec);
  load_plugins(spec, *loaded.registry, problems);
  loaded.graph = std::make_unique<Graph>(build_graph(spec, *loaded.registry, problems));
  expect::add_at_end(spec, *loaded.graph, problems);
  return loaded;
}

}  // namespace

Overrides without_changes(const Overrides& overrides) { return {"", {}, overrides.no_plugins}; }

const Registry& registry() {
  static const Registry known = make_registry();
  return known;
}

const std::vector<vehicles::VehicleClass>& known_vehicles() {
#ifdef JAROL_VEHICLES
  return vehicles::catalogue();
#else
  static const std::vector<vehicles::VehicleClass> none;
  return none;
#endif
}

Loaded load_without_channels(const std::string& path, const Overrides& overrides) {
  Problems problems;
  const GraphSpec spec = load_spec(read_source(path), overrides, problems);
  Loaded loaded = load(spec, problems);
  loaded.graph->expectations = expect::read_expectations(spec.expect, *loaded.graph, true_values_of(loaded), problems);
  problems.throw_if_any();
  return loaded;
}

Loaded load_graph(const std::string& path, const Overrides& overrides, std::uint64_t seed) {
  return load_graph(read_source(path), overrides, seed);
}

Loaded load_graph(const std::shared_ptr<const Source>& source, const Overrides& overrides, std::uint64_t seed) {
  Problems problems;
  const GraphSpec spec = load_spec(source, overrides, problems);
  Loaded loaded = load(spec, problems);
  loaded.channels = distributers::make_channels(*loaded.graph, known_vehicles(), seed, problems);
  loaded.graph->expectations = expect::read_expectations(spec.expect, *loaded.graph, true_values_of(loaded), problems);
  problems.throw_if_any();
  return loaded;
}

const Distributer* find_in_real_time(const Loaded& loaded) {
  for (std::size_t i = 0; i < loaded.channels.size(); ++i)
    if (loaded.channels[i]->needs_real_clock()) return &loaded.graph->distributers[i];
  return nullptr;
}

}  // namespace jarol::tools
