// What `jarol check` finds out about one graph: the verdict, its margins, what would help, and chains.
#pragma once

#include "tools/commands/check/check_report.h"

namespace jarol::tools {

/// Margins and suggestions come where they are found quickly, with `sensitivity` in any case; with `all_chains` also
/// every path from an `in` to an `out`. The graph stays the caller's.
CheckReport check_graph(const std::string& file, const Graph& graph, bool sensitivity, bool all_chains);

}  // namespace jarol::tools
