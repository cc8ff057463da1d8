// How long a task of a time table responds at most, without walking it: where the periods repeat too late.
#pragma once

#include "graph/analysis/system.h"

namespace jarol::analysis {

/// What is served in the order of arrival ends no later than J + sum of (releases in a window of length x) * WCET - x,
/// for some x that leads back from the arrival to one since which the core had no gap, J the longest jitter (the
/// maximum of sums along the way to it; Le Boudec, Thiran 2001, of FIFO). How offsets relate modulo the common divisor
/// of two periods says how near before an arrival another can be. Cores that wait for each other count as one. Empty if
/// a bound lies beyond its deadline, a core is all but full, or it would take more effort.
std::vector<Duration> fifo_bounds(const System& system, const std::vector<std::size_t>& core, Budget& budget);

}  // namespace jarol::analysis
