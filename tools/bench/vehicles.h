// The figure of a closed loop: the submarine's dive, beside plain code for the vehicle alone.
#pragma once

#include "tools/bench/figures.h"

namespace jarol::bench {

/// True where specs/exolauv.yaml is at hand and vehicles are built.
bool has_dive();

/// Microseconds for 10 ms of the dive; 100 of them are 100 times real time.
Figure measure_dive(int repeats);

}  // namespace jarol::bench
