// The static, non-preemptive time table of each core, as `run` walks it: tasks in the order of their arrivals, those of
// one instant in their turn, so that who is fed comes after who feeds.
#pragma once

#include "graph/analysis/one_core.h"

namespace jarol::analysis {

/// The order of activations on a core is fixed: a start is the latest of the release, the end of the one before and the
/// ends of those that it follows on other cores. Starts are maxima of sums, so nothing that comes earlier or takes less
/// makes anything later, and the walk with every jitter, `blocking` and WCET decides (Baccelli et al. 1992). It ends
/// where the backlog of every core is as one hyperperiod before; where that is not so after one hyperperiod more than
/// there are cores, some circle of waiting takes longer than there is time, and the backlog grows for ever: a longest
/// path through that many repetitions has a circle. `core` gives each task its core; of more activations than `max`
/// the verdict is unknown, unless `fifo_bounds` hold. `whole`: with responses where something is late, too.
CoreResult check_table(const System& system, const std::vector<std::size_t>& core, bool whole, Budget& budget,
                       std::uint64_t max = 5'000'000);

}  // namespace jarol::analysis
