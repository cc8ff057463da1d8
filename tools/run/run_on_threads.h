// A run with --concurrency threads.
#pragma once

#include "tools/run/load_graph.h"
#include "tools/run/real_time.h"

namespace jarol::tools {

/// Runs and tells; the exit code. Throws std::invalid_argument for a graph that threads can't run.
int run_on_threads(Loaded& loaded, Duration end, const RealTimeArguments& arguments, bool json);

}  // namespace jarol::tools
