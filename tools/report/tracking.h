// What an operator commanded beside what the vehicle reports: fields of one name that come in and go out through one
// distributer.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "distributers/session/reached.h"
#include "graph/model/graph.h"

namespace jarol::tools {

/// A table of what was commanded, reported as reached and truly reached last; `last_value` gives the newest value of a
/// communicator.
std::string reached_text(const Graph& graph, const std::function<const void*(std::size_t)>& last_value,
                         const std::vector<TrueState>& true_states);

/// All true values by the names of distributers.
nlohmann::ordered_json to_json(const std::vector<TrueState>& true_states);

}  // namespace jarol::tools
