// The threads on which a graph runs in real time, such that what runs is what check analyses.
#pragma once

#include <vector>

#include "graph/model/graph.h"

namespace jarol::analysis {

/// Tasks that one thread runs, each to its end; of those that are released at one instant, as dispatch_order says.
struct TaskThread {
  std::size_t core = 0;
  std::size_t urgency = 0;  // 0 is the most urgent one of its core, which preempts the others
  std::vector<std::size_t> tasks;
};

/// On the cores that check assigns. Of a table: one thread per core. Of fixed priorities: one for each task, but tasks
/// of a core that are always released together, follow each other in urgency and run in that order share one, for none
/// of them could preempt another; not behind one that waits for another thread. In order of core and urgency.
std::vector<TaskThread> threads_of(const Graph& graph);

/// May a communicator be due while a task of a table on one core runs, so that the thread that keeps the time must not
/// run tasks? By the bounds of `check`; false where it has none.
bool is_due_meanwhile(const Graph& graph);

}  // namespace jarol::analysis
