// Earliest deadline first on one core.
#pragma once

#include <vector>

#include "graph/analysis/task_model.h"

namespace jarol::analysis {

/// In [0, length] work of `demand` is due.
struct Demand {
  Duration length{};
  Duration demand{};                     // of tasks; the longest time that there is, where it is longer
  Duration blocking{};                   // by what can't be preempted
  std::vector<std::int64_t> releases{};  // per task, how many are due
};

struct EdfResult {
  bool decided = true;         // else no end was found in reasonable time
  std::optional<Demand> over;  // more is due than there is time for: not schedulable
};

/// Processor demand (Baruah, Rosier, Howell 1990; with jitter Spuri 1996), by QPA (Zhang, Burns 2009). Exact for
/// sporadic tasks, and for synchronous periodic ones without jitter. Non-preemptive: Jeffay, Stanat, Martel 1991, where
/// a task does not hold up its own activations; exact for sporadic tasks.
EdfResult check_edf(std::span<const TaskModel> models, bool preemptive, Budget& budget);

}  // namespace jarol::analysis
