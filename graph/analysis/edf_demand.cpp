#include "graph/analysis/edf_demand.h"

#include <algorithm>

namespace jarol::analysis {

std::int64_t releases_due(const Load& l, std::int64_t length) {
  const std::int64_t reach = length + l.jitter - l.deadline;
  return reach < 0 ? 0 : reach / l.period + 1;
}

Wide demand_bound(std::span<const Load> loads, std::int64_t length) {
  Wide sum = 0;
  for (const Load& l : loads) sum += static_cast<Wide>(releases_due(l, length)) * l.wcet;
  return sum;
}

std::int64_t blocking_bound(std::span<const Load> loads, std::int64_t length, bool preemptive) {
  std::int64_t most = 0;
  for (const Load& l : loads) {
    if (l.deadline - l.jitter <= length) most = std::max(most, l.blocking);
    // one whose activations are not due in it has begun before
    if (!preemptive && l.deadline - l.jitter > length) most = std::max(most, l.wcet - 1);
  }
  return most;
}

std::optional<std::int64_t> busy_period(std::span<const Load> loads, std::int64_t blocking, std::int64_t most,
                                        Effort& effort) {
  std::int64_t length = 1;
  while (true) {
    Wide next = blocking;
    for (const Load& l : loads) next += ceil_div(static_cast<Wide>(length) + l.jitter, l.period) * l.wcet;
    if (!effort.spend(loads.size()) || next > most) return std::nullopt;
    if (next == length) return length;
    length = static_cast<std::int64_t>(next);
  }
}

}  // namespace jarol::analysis
