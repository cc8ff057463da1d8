#include "graph/analysis/edf_demand.h"

#include <algorithm>

namespace jarol::analysis {

std::int64_t releases_due(const TaskModel& m, std::int64_t length) {
  const std::int64_t reach = length + m.jitter - m.deadline;
  return reach < 0 ? 0 : reach / m.period + 1;
}

Wide demand_bound(std::span<const TaskModel> models, std::int64_t length) {
  constexpr Wide max = static_cast<Wide>(1) << 125;  // beyond all lengths; more might be beyond 128 bits
  Wide sum = 0;
  for (const TaskModel& m : models) sum = std::min(max, sum + static_cast<Wide>(releases_due(m, length)) * m.wcet);
  return sum;
}

std::int64_t blocking_bound(std::span<const TaskModel> models, std::int64_t length, bool preemptive) {
  std::int64_t max = 0;
  for (const TaskModel& m : models) {
    if (m.deadline - m.jitter <= length) max = std::max(max, m.blocking);
    // one whose activations are not due in it has begun before
    if (!preemptive && m.deadline - m.jitter > length) max = std::max(max, m.wcet - 1);
  }
  return max;
}

std::optional<std::int64_t> busy_period(std::span<const TaskModel> models, std::int64_t blocking, std::int64_t max,
                                        Budget& budget) {
  std::int64_t length = 1;
  while (true) {
    Wide next = blocking;
    for (const TaskModel& m : models) next += ceil_div(static_cast<Wide>(length) + m.jitter, m.period) * m.wcet;
    if (!budget.spend(models.size()) || next > max) return std::nullopt;
    if (next == length) return length;
    length = static_cast<std::int64_t>(next);
  }
}

}  // namespace jarol::analysis
