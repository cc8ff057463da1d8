// One run of a campaign: the same as that of `jarol run` with its values and seed, whatever else runs beside it.
#pragma once

#include <atomic>
#include <optional>

#include "distributers/campaign/graphs.h"
#include "distributers/campaign/result.h"

namespace jarol::campaign {

/// Why the graph can't be run many times at once with that length; empty: it can. None: to the end of its mission.
std::string why_not_in_campaign(const PlannedGraph& graph, std::optional<Duration> length);

/// Whatever goes wrong in the run is its result. None: it was to stop before its end.
std::optional<Result> run_one(Graphs& graphs, const Start& start, std::optional<Duration> length,
                              const std::atomic<bool>& stop);

}  // namespace jarol::campaign
