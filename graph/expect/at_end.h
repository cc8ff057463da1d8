// What a graph states for the end of a run: what its operator commands then, and when its vehicle is at rest.
#pragma once

#include "graph/model/graph.h"

namespace jarol::expect {

/// Gives a graph, which has its communicators and tasks, what its key `at_end` says.
void add_at_end(const GraphSpec& spec, Graph& graph, Problems& problems);

}  // namespace jarol::expect
