// What a report says of the graph itself: its tasks, and what is to run when.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "graph/model/graph.h"

namespace jarol::tools {

/// {"verdict", "reason", "until_ns", "slices": [task, activation, begin, end] of a hyperperiod, or as much of it as
/// some 300 activations fill}, when each activation takes its WCET; null where a task has none.
nlohmann::ordered_json schedule_json(const Graph& graph);

/// In the order in which they run when released together.
nlohmann::ordered_json tasks_json(const Graph& graph);

}  // namespace jarol::tools
