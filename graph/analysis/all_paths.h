// Every way that data takes through a graph, from an `in` to an `out`.
#pragma once

#include <vector>

#include "graph/model/graph.h"

namespace jarol::analysis {

/// Of paths beside the chains that the graph names, a report shows so many at most.
inline constexpr std::size_t max_paths = 1000;

struct AllPaths {
  std::vector<std::vector<End>> paths;  // no more than `max_paths`
  bool more = false;                    // than these
  bool whole = true;                    // else the search took too many steps, and there may be more
};

/// Of a valid graph; none goes through a task twice. Ways that only lead back to themselves can be more than anyone can
/// walk, so that the search ends after some millions of steps.
AllPaths all_paths(const Graph& graph);

}  // namespace jarol::analysis
