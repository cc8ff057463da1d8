// A run with --concurrency threads.
#pragma once

#include "tools/commands/run/load_graph.h"
#include "tools/commands/run/run_options.h"

namespace jarol::tools {

/// Runs and reports; the exit code. Throws std::invalid_argument for a graph that threads can't run.
int run_on_threads(Loaded& loaded, Duration end, const RunOptions& options);

}  // namespace jarol::tools
