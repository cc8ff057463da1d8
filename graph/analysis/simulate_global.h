// What happens under global earliest deadline first when every activation takes its WCET and arrives as the offsets
// say.
#pragma once

#include "graph/analysis/simulate.h"

namespace jarol::analysis {

struct GlobalSimulation {
  bool repeats = false;  // nothing is late, and the last hyperperiod left all as the one before it
  std::uint64_t activations = 0;
  std::optional<Late> late;
  std::vector<std::int64_t> responses;  // per task, the longest of those that ended
  std::vector<Slice> slices;            // the last ones before the late activation ended
};

/// Up to the first late activation, or until one hyperperiod after all offsets leaves the same work as the one before,
/// or so many activations. Preemptive. Ties: the task that stands first. Releases follow the arrivals by all of the
/// jitter; who follows another (`follows`: producer, reader) starts where that has ended.
GlobalSimulation simulate_global(std::span<const Load> loads, std::int64_t cores, std::uint64_t most_activations,
                                 std::span<const std::pair<std::size_t, std::size_t>> follows = {});

}  // namespace jarol::analysis
