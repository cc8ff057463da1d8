// How late the engine on the real clock is, beside a bare sleeping loop.
#pragma once

#include <functional>
#include <string>

#include "graph/model/graph.h"
#include "runtime/record/sink.h"
#include "tools/bench/figures.h"

namespace jarol::bench {

/// That part of all latenesses, 0 to 1, at 1 kHz: from the instant to the first line of the task, and to the first line
/// after a bare clock_nanosleep.
Figure measure_clock(const std::string& name, double part, int repeats);

/// What that part of the latenesses of a run of half a second is at most, in us. A task `Stamp` of the graph begins
/// each millisecond, and goes on where it is late; the sink gets what is published.
double lateness_of_run(const Graph& graph, double part, RecordSink* sink = nullptr);

/// Of both the median of slices, in turn on one thread with a timer slack of 1 ns: the machine's own bursts are in few
/// of them.
Figure compare_lateness(std::string name, std::string text, double goal, int repeats,
                        const std::function<double()>& value, const std::function<double()>& floor);

}  // namespace jarol::bench
