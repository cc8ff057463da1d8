// What happens on several cores when every activation takes its WCET and arrives as the offsets say: under global
// earliest deadline first, or with tasks on cores of their own that wait for each other.
#pragma once

#include "graph/analysis/simulate.h"

namespace jarol::analysis {

struct GlobalSimulation {
  bool repeats = false;  // nothing is late, and the last hyperperiod left all as the one before it
  std::uint64_t activations = 0;
  std::optional<DeadlineMiss> late;
  std::vector<Duration> responses;  // per task, the longest of those that ended
  std::vector<Slice> slices;        // the last ones before the late activation ended
  Duration slices_from{};           // of what ran later none is missing there
};

/// What runs where and before what; global EDF without any.
struct RunRules {
  std::span<const std::pair<std::size_t, std::size_t>> follows{};  // producer, reader
  std::span<const std::size_t> core{};                             // per task; none: on any
  std::vector<std::size_t> order{};  // per task, of equals or of all (`by_order`); none: as they stand
  bool by_order = false;
  bool preemptive = true;
};

/// Up to the first late activation, or until one hyperperiod after all offsets leaves the same work as the one before,
/// or so many activations. Releases follow the arrivals by all of the jitter; who follows another starts where that has
/// ended.
GlobalSimulation simulate_global(std::span<const TaskModel> models, std::int64_t cores, std::uint64_t max_activations,
                                 const RunRules& rules = {});

/// The last pieces that ran before `until` or the first late activation, at least 400 of them.
std::vector<Slice> slices_before(Duration until, std::span<const TaskModel> models, std::int64_t cores,
                                 const RunRules& rules);

}  // namespace jarol::analysis
