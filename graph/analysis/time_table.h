// The static, non-preemptive time table of each core, as `run` walks it: tasks in the order of their releases, those of
// one instant stage by stage, so that who is fed comes after who feeds.
#pragma once

#include "graph/analysis/one_core.h"

namespace jarol::analysis {

/// The order of activations on a core is fixed, so a start is the latest of its release, the end of the one before and
/// the ends of those that it follows: shorter execution never makes anything later, and the walk with every WCET
/// decides. It covers the largest offset and two hyperperiods: from then on the backlog repeats (Lindley 1952). More
/// activations than `most`: unknown, and said so. `core` gives each task its core. A table of up to 50,000 activations
/// is looked at once more by `fault_of_table`.
CoreResult check_table(const System& system, const std::vector<std::size_t>& core, std::uint64_t most = 5'000'000);

}  // namespace jarol::analysis
