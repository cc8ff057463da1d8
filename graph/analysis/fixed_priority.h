// Fixed priorities on one core: worst-case response times over all offsets.
#pragma once

#include "graph/analysis/task_model.h"

namespace jarol::analysis {

/// Per task, from its arrival; nothing where it grows without bound or no end was found in reasonable time.
/// Preemptive: exact for sporadic and for synchronous periodic tasks (Joseph, Pandya 1986; Audsley et al. 1993), later
/// activations of a busy period included (Lehoczky 1990), with jitter and blocking (Tindell et al. 1994).
/// Non-preemptive: every start in the busy period (George, Rivierre, Spuri 1996; Davis et al. 2007).
std::vector<std::optional<Duration>> fixed_priority_responses(std::span<const TaskModel> models, bool preemptive,
                                                              Budget& budget);

}  // namespace jarol::analysis
