// In which order the tasks that are released at one instant may run.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "graph/model/graph.h"

namespace jarol {

/// Tasks of one period and offset form a group, always released together.
struct Stages {
  /// Per task: later than of every producer of another group that can be due at the same instant.
  std::vector<std::uint32_t> stage;
  /// Per task, within its group and stage: later than of every producer there.
  std::vector<std::uint32_t> level;
};

Stages stages_of(const Graph& graph);

/// Of each group, by period and offset: the least deadline of its tasks.
using GroupDeadlines = std::map<std::pair<Duration, Duration>, Duration>;
GroupDeadlines group_deadlines(const Graph& graph);

/// The tasks in the order in which those that are released at one instant run one after the other: by stage, then by
/// group (its least deadline, period, offset), then by level, then by deadline, then as in the order of the graph. Of
/// tasks released together that don't feed each other, the order by deadline meets all deadlines if any order does
/// (Jackson 1955).
std::vector<std::size_t> dispatch_order(const Graph& graph);

}  // namespace jarol
