// How fast the water or the air moves in a simulation: a page draws an arrow for it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "distributers/interfaces/vehicle.h"
#include "graph/model/graph.h"
#include "graph/named_list.h"

namespace jarol::tools::console {

/// In the mean, without gusts and waves.
struct Flow {
  std::string of;                // current or wind
  double north = 0.0, east = 0;  // m/s
};

/// Of the first simulated vehicle of which it is known; `files`: that the graph was read from, among them those of
/// vehicles.
std::optional<Flow> find_flow(const Graph& graph, const NamedList<vehicles::VehicleClass>& vehicles,
                              const std::vector<std::shared_ptr<const Source>>& files);

}  // namespace jarol::tools::console
