// The chains of a graph: paths that its connections allow.
#pragma once

#include "graph/model/graph.h"

namespace jarol {

/// Resolves the paths that the spec names; what is not there or not connected is reported.
void add_chains(const GraphSpec& spec, Graph& graph, Problems& problems);

}  // namespace jarol
