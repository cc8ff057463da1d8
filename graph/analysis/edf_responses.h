// How long tasks take under earliest deadline first on one core.
#pragma once

#include "graph/analysis/task_model.h"

namespace jarol::analysis {

/// Worst-case response times from the arrival over all offsets, ties against the task, whether deadlines are met or
/// not: Spuri 1996, non-preemptive George, Rivierre, Spuri 1996. Where that would take long, the deadline less the
/// least time that is left in any interval, which no response is beyond. Empty if utilisation is beyond one or that
/// takes long too.
std::vector<Duration> edf_responses(std::span<const TaskModel> models, bool preemptive, Budget& budget);

/// Is a task late with its own `blocking` alone, where of equal deadlines the task that stands first goes first? False
/// if that takes long.
bool is_late_by_own_blocking(std::span<const TaskModel> models, bool preemptive, Budget& budget);

}  // namespace jarol::analysis
