// What a graph takes to run on the real clock: threads, and that check has nothing against it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "distributers/session/run_options.h"
#include "graph/analysis/threads.h"
#include "graph/model/graph.h"

namespace jarol {

/// Throws NotExecutable where nothing executes the graph's policy; `name` is what the user called the graph.
void require_executed(const std::string& name, const Graph& graph, const RunWords& words = {});

/// The threads that run tasks, where it takes more than the one that keeps the time: several cores, priorities, or a
/// communicator that is due while a task runs; completes the options for them.
/// Throws NotExecutable too where this machine has too few CPUs, or SCHED_FIFO too few priorities.
std::vector<analysis::TaskThread> threads_for(const std::string& name, const Graph& graph, RealTimeOptions& options,
                                              const RunWords& words = {});

struct CheckFindings {
  std::string against;  // "is not schedulable: ...", "breaks a limit of chain ..."; empty: nothing
  std::string unknown;  // why it is not known
};

CheckFindings find_against(const Graph& graph);

/// Throws NotExecutable as above, and unless forced NotSchedulable for a graph that check finds not schedulable, or to
/// break a chain's limit; what check can't say is noted, and what is run by force where that is asked for.
void require_executable(const std::string& name, const Graph& graph, const RunOptions& options);

/// Gives the calling thread that priority under SCHED_FIFO, and those that it makes from now on, as the threads of
/// links. Where that is refused, it is so for the thread that keeps the time, which notes it.
void take_priority(std::optional<int> priority);
/// Likewise the one above it: the thread that attends a run goes before the one that it attends.
void take_priority_above(std::optional<int> priority);

}  // namespace jarol
