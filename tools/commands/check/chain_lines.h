// What the report of a check says of chains, and of outputs that read late.
#pragma once

#include <string>

#include "tools/commands/check/check_report.h"

namespace jarol::tools {

/// Latencies of each chain, its slowest way, what a loop loses by it, and limits that are or may be broken.
std::string chain_lines(const CheckReport& report);

/// A note for each `out` that reads at the very instant at which its data-flow producer runs.
std::string late_outs(const Graph& graph);

}  // namespace jarol::tools
