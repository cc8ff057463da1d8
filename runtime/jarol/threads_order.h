// In which order threads run the tasks of a round.
#pragma once

#include <cstddef>
#include <vector>

#include "graph/model/graph.h"

namespace jarol {

/// Tasks in data-flow order as if none had a LET, ties in order of name; a cycle is entered at a task that is fed by a
/// LET task, whose output of the round before it reads.
std::vector<std::size_t> threads_order(const Graph& graph);

}  // namespace jarol
