// What earliest deadline first on one core has to do in an interval.
#pragma once

#include "graph/analysis/task_model.h"

namespace jarol::analysis {

inline constexpr std::int64_t far = std::int64_t{1} << 61;  // no length is beyond it
inline constexpr std::uint64_t max_edf_steps = 50'000'000;  // of one question

/// Releases with a deadline within `length` of an arrival as late as jitter allows.
std::int64_t releases_due(const TaskModel& model, std::int64_t length);
/// Work due in any interval of that length.
Wide demand_bound(std::span<const TaskModel> models, std::int64_t length);
/// The longest that what can't be preempted takes from an interval of that length.
std::int64_t blocking_bound(std::span<const TaskModel> models, std::int64_t length, bool preemptive);
/// Length of the synchronous busy period, or nothing if it is longer than `max`.
std::optional<std::int64_t> busy_period(std::span<const TaskModel> models, std::int64_t blocking, std::int64_t max,
                                        Budget& budget);

}  // namespace jarol::analysis
