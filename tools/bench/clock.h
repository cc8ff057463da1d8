// How late the engine on the real clock is, beside a bare sleeping loop.
#pragma once

#include <string>

#include "tools/bench/figures.h"

namespace jarol::bench {

/// That part of all latenesses, 0 to 1, at 1 kHz: from the instant to the first line of the task, and to the first line
/// after a bare clock_nanosleep: the median of slices of half a second. Both on one thread with a timer slack of 1 ns,
/// in turn.
Figure measure_clock(const std::string& name, double part, int repeats);

}  // namespace jarol::bench
