// Whether a vehicle came to rest as its graph states, and what of the run before is judged.
#pragma once

#include <optional>
#include <string>

#include "graph/model/graph.h"
#include "runtime/execute/attend.h"
#include "runtime/execute/rest.h"

namespace jarol {

/// How long the vehicle may take, on the real clock; none: the graph does not state how it comes to rest.
std::optional<Duration> longest_rest(const Graph& graph);

/// What the run was to end for.
Ending asked_ending(const RunEnd& end);
/// Something else ended it.
bool is_cut_short(const RunEnd& end);

/// Why it did not come to rest, as a sentence; empty: it did, or was not to.
std::string not_at_rest_text(const Graph& graph, const std::optional<RestReport>& rest, const RunEnd& end);

/// Where the part of a run ends that its expectations are of.
Duration judged_until(const std::optional<Duration>& rest_begun, Duration until, Duration reached);

}  // namespace jarol
