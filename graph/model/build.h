// From the specification to a valid graph.
#pragma once

#include "graph/language/spec.h"
#include "graph/model/graph.h"

namespace jarol {

/// Resolves names and types, checks all that the pages of specs/ demand, derives deadlines and order. All that is
/// wrong goes to `problems`; the graph is whole only if nothing was added.
Graph build_graph(const GraphSpec& spec, const Registry& registry, Problems& problems);

}  // namespace jarol
