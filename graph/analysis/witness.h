// A run of one core in which an activation is late, to show why.
#pragma once

#include "graph/analysis/one_core.h"

namespace jarol::analysis {

/// Adds the first late activation of those that arrive before `until`, and what ran before its end, where every
/// activation takes its WCET and arrives as the offsets say.
void add_witness(const CoreTasks& tasks, const Policy& policy, std::int64_t until, CoreResult& result);

}  // namespace jarol::analysis
