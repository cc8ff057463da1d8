// Deadlines and order of execution: what follows from connections and timing alone.
#pragma once

#include "graph/model/graph.h"

namespace jarol {

/// Time from a release of one (period, offset) to the first later instant of another, the least over all releases:
/// `(other_offset - offset) mod gcd(period, other_period)`, 0 counting as the gcd.
Duration min_distance(Duration period, Duration offset, Duration other_period, Duration other_offset);

/// Tasks in data-flow order: a task without a LET before those it feeds, ties in order of name. A cycle of connections
/// without a LET task is reported and printed.
std::vector<std::size_t> data_flow_order(const Graph& graph, Problems& problems);

/// Fills in each task's deadline: the LET, or the derived one; `declared[i]` may lower it and is reported if larger.
void set_deadlines(Graph& graph, const std::vector<Maybe<Duration>>& declared, Problems& problems);

}  // namespace jarol
