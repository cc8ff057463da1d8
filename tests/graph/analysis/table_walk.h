// A table, walked with every WCET, jitter and hold-up at its longest until the backlog of every core is what it was a
// hyperperiod before. The order on a core is fixed, so that nothing shorter makes anything later: this is exact. Shares
// no code with graph/analysis.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/model/graph.h"

namespace jarol::truth {

struct TableWalk {
  std::string late;                   // the first late activation, as "d 4 ends at 22ns, due at 20ns", or nothing
  std::vector<std::int64_t> longest;  // response per task, ns
  std::int64_t hyperperiods = 0;      // until it was seen to repeat, or somebody was late
};

TableWalk walk_table(const Graph& graph, const std::vector<std::size_t>& core);

}  // namespace jarol::truth
