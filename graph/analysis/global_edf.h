// Global earliest deadline first on several cores: sufficient tests.
#pragma once

#include "graph/analysis/task_model.h"

namespace jarol::analysis {

/// Goossens, Funk, Baruah 2003: sum of densities <= m - (m - 1) largest density, where a task with jitter has its
/// deadline less that: its activations fit a processor of that speed of their own, one after the other. Without
/// rounding up to what a double holds, on the safe side.
bool passes_gfb(std::span<const TaskModel> models, std::int64_t cores);

/// Bertogna, Cirinei 2007: upper bounds of response times from the arrival with iterated slack; nothing for a task that
/// none was found for with that effort, and for none where a task can't end by its deadline even alone. They hold where
/// all deadlines do, by these bounds or otherwise. Sufficient for constrained deadlines. What a task executes in a
/// window is bounded by its arrivals and deadlines alone, so that jitter only shortens the time of the task that is
/// looked at.
std::vector<std::optional<Duration>> global_edf_responses(std::span<const TaskModel> models, std::int64_t cores,
                                                          Budget& budget);

}  // namespace jarol::analysis
