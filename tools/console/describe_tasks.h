// The tasks of a graph as a page gets them: when they run, whether that holds, and what they were given.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "graph/model/graph.h"

namespace jarol::tools::console {

/// What a task or distributer was given, leaf by leaf, and what it would have been.
nlohmann::ordered_json describe_parameters(const Type& type, const Value& parameters);

/// Adds "tasks", "verdict", and "schedule" where each task has a WCET.
void describe_tasks(const Graph& graph, nlohmann::ordered_json& to);

}  // namespace jarol::tools::console
