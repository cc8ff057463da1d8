// From a file name to a graph that can run: what every command that takes a graph does first.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "distributers/interfaces/vehicle.h"
#include "graph/language/load.h"
#include "graph/model/graph.h"
#include "runtime/channels.h"

namespace jarol::tools {

/// Every task and distributer that this program knows.
const Registry& registry();

struct Loaded {
  std::unique_ptr<Registry> registry;  // with the graph's plugins
  std::unique_ptr<Graph> graph;
  std::vector<std::unique_ptr<Channels>> channels;
};

/// The file as it stands, its plugins as allowed.
Overrides without_changes(const Overrides& overrides);

/// Every vehicle that this program has.
const std::vector<vehicles::VehicleClass>& known_vehicles();

/// Throws SpecError with everything that is wrong with the file, its overrides and its links. The seed is that of all
/// noise. A plugin is named on stderr before it is loaded.
Loaded load_graph(const std::string& path, const Overrides& overrides, std::uint64_t seed = 0);
Loaded load_graph(const std::shared_ptr<const Source>& source, const Overrides& overrides, std::uint64_t seed = 0);

/// The same without channels: of the files that links name, none is needed.
Loaded load_without_channels(const std::string& path, const Overrides& overrides);

/// A distributer whose external system goes on by itself, whatever the logical clock says; null: none does.
const Distributer* find_in_real_time(const Loaded& loaded);

}  // namespace jarol::tools
