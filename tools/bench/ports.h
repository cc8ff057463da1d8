// What it costs to get 64 bytes from one thread to another.
#pragma once

#include "tools/bench/figures.h"

namespace jarol::bench {

/// Time per message, of a writer that never pauses; beside a plain ring.
Figure measure_port_throughput(const std::string& name, int repeats);
Figure measure_push_port_throughput(const std::string& name, int repeats);

/// Time there and back, of one message at a time; beside a plain ring.
Figure measure_port_round_trip(const std::string& name, int repeats);
Figure measure_push_port_round_trip(const std::string& name, int repeats);

}  // namespace jarol::bench
