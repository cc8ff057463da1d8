// Preemptive policies on one core with offsets that hold and releases that jitter: every worst case, one after the
// other.
#pragma once

#include "graph/analysis/one_core.h"

namespace jarol::analysis {

struct Extremes {
  bool whole = false;  // every busy period was looked at, and none is late in doubt
  bool idle = true;    // each came to its end
  std::optional<DeadlineMiss> late;
  std::vector<Duration> responses;  // per model, the longest
  std::vector<Slice> slices;        // before the late activation ended
  Duration slices_from{};           // of what ran later none is missing there
};

/// What an activation waits for lies within a busy period, which begins at some instant t with a release. It is longest
/// if all that can be released at t rather than before it are, and all later ones as they arrive, each with its WCET;
/// and t is the latest release of one of them: so that one walk from each such instant of a repetition decides (as
/// Tindell 1994 and Palencia, Gonzalez 1998 do for transactions, with all their combinations). `blocking` comes at t,
/// as long as it can be for the activation that is looked at; under EDF what holds up one with an earlier deadline
/// holds up those behind it, so that these are looked at with the longest, though late for sure only with their own.
/// Loads are most urgent first; each that follows another is less urgent than it. Up to the first late activation,
/// unless `beyond_late`.
Extremes walk_extremes(const CoreTasks& tasks, Order order, bool beyond_late, Budget& budget);

}  // namespace jarol::analysis
