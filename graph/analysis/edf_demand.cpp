#include "graph/analysis/edf_demand.h"

#include <algorithm>

namespace jarol::analysis {

std::int64_t releases_due(const TaskModel& m, Duration length) {
  const Duration reach = length + m.jitter - m.deadline;
  return reach < Duration{} ? 0 : reach / m.period + 1;
}

Wide demand_bound(std::span<const TaskModel> models, Duration length) {
  constexpr Wide max = static_cast<Wide>(1) << 125;  // beyond all lengths; more might be beyond 128 bits
  Wide sum = 0;
  for (const TaskModel& m : models)
    sum = std::min(max, sum + static_cast<Wide>(releases_due(m, length)) * m.wcet.count());
  return sum;
}

Duration blocking_bound(std::span<const TaskModel> models, Duration length, bool preemptive) {
  Duration max{};
  for (const TaskModel& m : models) {
    if (m.deadline - m.jitter <= length) max = std::max(max, m.blocking);
    // one whose activations are not due in it has begun before
    if (!preemptive && m.deadline - m.jitter > length) max = std::max(max, m.wcet - Duration(1));
  }
  return max;
}

std::optional<Duration> busy_period(std::span<const TaskModel> models, Duration blocking, Duration max,
                                    Budget& budget) {
  std::int64_t length = 1;
  while (true) {
    Wide next = blocking.count();
    for (const TaskModel& m : models)
      next += ceil_div(static_cast<Wide>(length) + m.jitter.count(), m.period.count()) * m.wcet.count();
    if (!budget.spend(models.size()) || next > max.count()) return std::nullopt;
    if (next == length) return Duration(length);
    length = static_cast<std::int64_t>(next);
  }
}

}  // namespace jarol::analysis
