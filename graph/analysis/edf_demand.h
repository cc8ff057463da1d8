// What earliest deadline first on one core has to do in an interval.
#pragma once

#include "graph/analysis/task_model.h"

namespace jarol::analysis {

inline constexpr Duration far{std::int64_t{1} << 61};       // no length is beyond it
inline constexpr std::uint64_t max_edf_steps = 50'000'000;  // of one question

/// Releases with a deadline within `length` of an arrival as late as jitter allows.
std::int64_t releases_due(const TaskModel& model, Duration length);
/// Work due in any interval of that length, in ns.
Wide demand_bound(std::span<const TaskModel> models, Duration length);
/// The longest that what can't be preempted takes from an interval of that length.
Duration blocking_bound(std::span<const TaskModel> models, Duration length, bool preemptive);
/// Length of the synchronous busy period, or nothing if it is longer than `max`.
std::optional<Duration> busy_period(std::span<const TaskModel> models, Duration blocking, Duration max, Budget& budget);

}  // namespace jarol::analysis
