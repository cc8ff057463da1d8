// How a vehicle came to rest at the end of a run, in its report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "distributers/session/rest_verdict.h"
#include "graph/model/graph.h"
#include "runtime/execute/attend.h"
#include "runtime/execute/rest.h"

namespace jarol::tools {

/// What is commanded, of a graph that states it: "from_terminal {heard: false}", and by communicator.
std::string command_text(const Graph& graph);
nlohmann::ordered_json command_to_json(const Graph& graph);

/// A line for stderr as that begins.
std::string rest_begins_text(const Graph& graph, const Ending& why);

/// A line of the report, or nothing.
std::string to_text(const Graph& graph, const std::optional<RestReport>& rest, const RunEnd& end);
nlohmann::ordered_json to_json(const Graph& graph, const std::optional<RestReport>& rest, const RunEnd& end);

}  // namespace jarol::tools
