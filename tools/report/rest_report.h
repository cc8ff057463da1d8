// How a vehicle came to rest at the end of a run, in its report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "graph/model/graph.h"
#include "runtime/execute/attend.h"
#include "runtime/execute/rest.h"

namespace jarol::tools {

/// How long the vehicle may take, on the real clock; none: the graph does not state how it comes to rest.
std::optional<Duration> longest_rest(const Graph& graph);

/// What is commanded, of a graph that states it: "from_terminal {heard: false}", and by communicator.
std::string command_text(const Graph& graph);
nlohmann::ordered_json command_to_json(const Graph& graph);

/// A line for stderr as that begins.
std::string rest_begins_text(const Graph& graph, const Ending& why);

/// A line of the report, or nothing.
std::string to_text(const Graph& graph, const std::optional<RestReport>& rest, const RunEnd& end);
nlohmann::ordered_json to_json(const Graph& graph, const std::optional<RestReport>& rest, const RunEnd& end);

/// Why it did not come to rest, as a sentence; empty: it did, or was not to.
std::string not_at_rest_text(const Graph& graph, const std::optional<RestReport>& rest, const RunEnd& end);

/// Where the part of a run ends that its expectations are of.
Duration judged_until(const std::optional<Duration>& rest_begun, Duration until, Duration reached);

}  // namespace jarol::tools
