// Earliest deadline first on one core.
#pragma once

#include "graph/analysis/load.h"

namespace jarol::analysis {

/// In [0, length] work of `demand` is due.
struct Demand {
  std::int64_t length = 0;
  std::int64_t demand = 0;    // of tasks
  std::int64_t blocking = 0;  // by what can't be preempted
};

struct EdfResult {
  bool decided = true;         // else no end was found in reasonable time
  std::optional<Demand> over;  // more is due than there is time for: not schedulable
};

/// Work due in any interval of that length.
Wide demand_bound(std::span<const Load> loads, std::int64_t length);

/// Processor demand (Baruah, Rosier, Howell 1990; with jitter Spuri 1996), by QPA (Zhang, Burns 2009). Exact for
/// sporadic tasks, and for synchronous periodic ones without jitter. Non-preemptive: Jeffay, Stanat, Martel 1991, where
/// a task does not hold up its own activations; exact for sporadic tasks.
EdfResult check_edf(std::span<const Load> loads, bool preemptive, Effort& effort);

/// Worst-case response times from the arrival over all offsets, ties against the task, whether deadlines are met or
/// not: Spuri 1996, non-preemptive George, Rivierre, Spuri 1996. Where that would take long, the deadline less the
/// least time that is left in any interval, which no response is beyond. Empty if utilisation is beyond one or that
/// takes long too.
std::vector<std::int64_t> edf_responses(std::span<const Load> loads, bool preemptive, Effort& effort);

/// Is a task late with its own `blocking` alone, where of equal deadlines the task that stands first goes first? False
/// if that takes long.
bool is_late_by_own_blocking(std::span<const Load> loads, bool preemptive, Effort& effort);

}  // namespace jarol::analysis
