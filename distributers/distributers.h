// The catalogue of distributers, and the way from a valid graph to its channels.
#pragma once

#include <memory>
#include <vector>

#include "distributers/interfaces/vehicle.h"
#include "distributers/links/link.h"
#include "graph/model/graph.h"
#include "runtime/channels.h"

namespace jarol::distributers {

/// Adds every distributer class of this folder.
void add_distributers(Registry& registry);

/// The channels of each distributer of the graph, in its order, linked as the file says; `vehicles` are those that
/// `simulation` links may name, and each gets its share of the seed by the distributer's name. What is wrong goes to
/// `problems`, and a null stands in the place.
std::vector<std::unique_ptr<Channels>> make_channels(const Graph& graph,
                                                     const std::vector<vehicles::VehicleClass>& vehicles,
                                                     std::uint64_t seed, Problems& problems);

/// The packets that bring the external system of that distributer to rest, whatever it was told before: its `out`s with
/// a `safe` hand that over. By the translator of its link, which is not connected yet.
std::vector<std::vector<std::byte>> safe_packets(const Graph& graph, std::size_t distributer, Link& link);

}  // namespace jarol::distributers
