// What a graph takes to run on the real clock: threads, and that check has nothing against it.
#pragma once

#include <string>
#include <vector>

#include "graph/analysis/threads.h"
#include "graph/model/graph.h"
#include "runtime/machine/real_clock.h"

namespace jarol {

/// How what a message asks to be changed is called where it comes from.
struct RealTimeWords {
  std::string priority = ".real_time.priority";
  std::string cpus = ".real_time.cpus";
  std::string set = ".set";
};

/// Throws NotExecutable where nothing executes the graph's policy; `name` is what the user called the graph.
void require_executed(const std::string& name, const Graph& graph, const RealTimeWords& words = {});

/// The threads that run tasks, where it takes more than the one that keeps the time: several cores, priorities, or a
/// communicator that is due while a task runs; completes the options for them.
/// Throws NotExecutable too where this machine has too few CPUs, or SCHED_FIFO too few priorities.
std::vector<analysis::TaskThread> threads_for(const std::string& name, const Graph& graph, RealTimeOptions& options,
                                              const RealTimeWords& words = {});

struct CheckFindings {
  std::string against;  // "is not schedulable: ...", "breaks a limit of chain ..."; empty: nothing
  std::string unknown;  // why it is not known
};

CheckFindings find_against(const Graph& graph);

}  // namespace jarol
