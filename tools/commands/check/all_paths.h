// Every way that data takes through a graph, from an `in` to an `out`.
#pragma once

#include <vector>

#include "graph/model/graph.h"

namespace jarol::tools {

/// Of paths beside the chains that the graph names, a report shows so many at most.
inline constexpr std::size_t max_paths = 1000;

struct AllPaths {
  std::vector<std::vector<End>> paths;  // no more than `max_paths`
  bool more = false;                    // than these
};

/// Of a valid graph; none goes through a task twice.
AllPaths all_paths(const Graph& graph);

}  // namespace jarol::tools
