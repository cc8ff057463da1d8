// A run of one core in which an activation is late, to show why.
#pragma once

#include "graph/analysis/one_core.h"
#include "graph/analysis/simulate.h"

namespace jarol::analysis {

/// Adds the first late activation of a run, and what ran before its end, where every activation takes its WCET and
/// arrives as the offsets say. The run goes on until what arrives before `until` has ended; one in which readers wait
/// for what they follow over 2000 activations, whatever `until` is. None where it has none late.
void add_witness(const CoreTasks& tasks, Order order, bool preemptive, Duration until, CoreResult& result);

}  // namespace jarol::analysis
