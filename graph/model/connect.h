// The connections of a graph: both ends found, their types compared, every input fed once.
#pragma once

#include "graph/model/graph.h"

namespace jarol {

/// Fills in the connections of a graph whose tasks and communicators are there, by reader, and reports what is wrong.
/// False: some end is not known, so that order and deadlines make no sense.
bool connect(const GraphSpec& spec, Graph& graph, Problems& problems);

}  // namespace jarol
