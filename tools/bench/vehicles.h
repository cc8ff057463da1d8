// The figures of closed loops: the submarine's dive and the helicopter's hover, beside plain code for the vehicle
// alone.
#pragma once

#include "tools/bench/figures.h"

namespace jarol::bench {

/// Whether vehicles are built.
bool has_vehicles();

/// Whether the graphs that these figures run are here, in the working directory.
bool has_graphs();

/// Microseconds for 10 ms of the dive; 100 of them are 100 times real time.
Figure measure_dive(int repeats);

/// The same 10 ms with `dynamics: rigid`, beside those with Simbody.
Figure measure_dive_rigid(int repeats);

/// Microseconds for 15 ms of the hover; 250 of them are 60 times real time.
Figure measure_hover(int repeats);

/// The same 15 ms with `dynamics: rigid`, beside those with Simbody.
Figure measure_hover_rigid(int repeats);

/// Microseconds for a checkpoint of the hover, in memory.
Figure measure_checkpoint(int repeats);

}  // namespace jarol::bench
