// Non-preemptive policies on one core with offsets that hold: every order in which activations can start.
#pragma once

#include "graph/analysis/one_core.h"

namespace jarol::analysis {

struct Exploration {
  bool whole = false;  // every state was looked at, or a late activation found
  std::optional<DeadlineMiss> late;
  std::vector<Duration> responses;  // per model, the longest
};

/// The schedule-abstraction graph of one core (Nasri, Brandenburg 2017), exact: a state is which activations have
/// started, and the interval of instants at which the core may be free after them; states of the same activations whose
/// intervals meet are one. Executions take from nothing to their WCET, releases jitter. States are the same a
/// hyperperiod later, so that it ends where no new one is left. What holds up an activation with a `blocking` begins
/// once while the core is idle: for each length there are two states more, while it goes on and when it is over. Those
/// that it can't hold up for so long interrupt it; whoever starts behind one that waited for it may be late by it, too.
Exploration explore(const CoreTasks& tasks, Order order, Budget& budget);

}  // namespace jarol::analysis
