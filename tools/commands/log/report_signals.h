// The numbers of a recording as the page of a report draws them: all of them, or of a large recording the least and
// the greatest of each piece of time.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "runtime/record/recorded_run.h"

namespace jarol::tools {

/// So many values of a topic are all in the page; of more it has `pieces` pieces.
struct Thinning {
  std::size_t max_values = 4096;
  std::size_t pieces = 2048;
};

/// Less for a recording of very many signals, so that the page stays of a size that browsers open.
Thinning thinning_for(std::size_t columns);

/// Of everything that is published: {"topics", "signals", "sequences": names of those that are no numbers}.
nlohmann::ordered_json signals_json(const RecordedRun& run);

/// The signals of places in space: {"name", "x", "y", "z", "down"}, of indices into "signals".
nlohmann::ordered_json paths_json(const nlohmann::ordered_json& signals);

}  // namespace jarol::tools
