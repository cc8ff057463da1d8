// A value as JSON, led by its description: structs as objects, arrays as lists, numbers exactly.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "graph/model/graph.h"

namespace jarol::tools {

nlohmann::ordered_json to_json(const Type& type, const void* value);

/// As a graph says it: durations with their unit, enumerators and texts bare, all else as JSON.
std::string graph_text(const Type& type, const void* value);

/// What each `out` communicator of the graph had last; `last_value` gives the newest value of a communicator.
nlohmann::ordered_json outputs_to_json(const Graph& graph, const std::function<const void*(std::size_t)>& last_value);

}  // namespace jarol::tools
