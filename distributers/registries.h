// All that graphs and commands may name: what is built in, and what a program or a plugin adds.
#pragma once

#include "distributers/interfaces/vehicle.h"
#include "distributers/links/link_type.h"
#include "graph/named_list.h"
#include "graph/plugins/plugins.h"

namespace jarol::distributers {

/// A description and a factory for each; loader, help, reference and JSON Schema read them. Filled by `add_policies`,
/// `add_tasks`, `add_distributers`, `add_links`, `add_vehicles` and whoever has more.
struct Registries {
  Registry graph;  // task types, distributers, policies and grammars
  NamedList<LinkType> links;
  NamedList<vehicles::VehicleClass> vehicles;
  std::vector<LoadedPlugin> plugins{};  // of a graph: what they bring is among all that
};

/// Is one of that kind and name among what is known beside the graph's registry?
bool has(const Registries& known, const Extension& extension);

/// The same with another registry of graphs, and the vehicles and link types that plugins have brought.
Registries with_plugins(const Registries& known, PluginParts parts);

}  // namespace jarol::distributers
