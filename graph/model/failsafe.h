// What a graph declares for an external system that reports nothing more: after how long, and what its actuators get.
#pragma once

#include "graph/model/graph.h"

namespace jarol {

/// Gives the communicators of a graph, which have their channels and types, their time-outs and safe values. One
/// without the other is reported.
void add_failsafe(const GraphSpec& spec, Graph& graph, Problems& problems);

/// Those `in` communicators with a time-out that an `out` with a safe value goes by: all of its distributer.
std::vector<std::size_t> watched_by(const Graph& graph, const Communicator& out);

}  // namespace jarol
