// Do the values that a graph begins with fit the private heaps of its tasks?
#pragma once

#include "graph/model/graph.h"

namespace jarol {

/// Reports each task whose heap is too small for the initial values of its outputs and inputs.
void check_heaps(const Graph& graph, Problems& problems);

/// What `end`, the left of an arrow, reads as until first published.
const void* initial_value(const Graph& graph, const End& end);

}  // namespace jarol
