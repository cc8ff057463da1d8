// One run of a campaign: the same as that of `jarol run` with its values and seed, whatever else runs beside it.
#pragma once

#include <optional>

#include "distributers/campaign/graphs.h"
#include "distributers/campaign/oversight.h"
#include "distributers/campaign/result.h"
#include "graph/text/errors.h"

namespace jarol::campaign {

/// Why the graph can't be run many times at once with that length; empty: it can. None: to the end of its mission.
std::string why_not_in_campaign(const PlannedGraph& graph, std::optional<Duration> length);

/// A run needs a file that the campaign has not read before its first run.
struct UnreadFile : InputError {
  using InputError::InputError;
};

/// Whatever goes wrong in the run is its result. None: it was to stop before its end. Throws UnreadFile, and
/// std::bad_alloc or std::system_error where there is no memory or no thread for it, as there may be later.
std::optional<Result> run_one(Graphs& graphs, const Start& start, std::optional<Duration> length,
                              const Oversight& oversight);

}  // namespace jarol::campaign
