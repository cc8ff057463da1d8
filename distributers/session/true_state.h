// Where the vehicles of a run truly are.
#pragma once

#include <string>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/external_system.h"

namespace jarol {

/// Where the vehicle of a distributer truly is.
struct TrueState {
  std::string distributer;
  Value values;
};

/// Of each vehicle that is simulated in these systems, one per distributer of the graph.
std::vector<TrueState> find_true_states(const Graph& graph, const std::vector<ExternalSystem*>& systems);

}  // namespace jarol
