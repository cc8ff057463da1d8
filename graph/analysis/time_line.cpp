#include "graph/analysis/time_line.h"

#include <algorithm>
#include <numeric>

#include "graph/analysis/simulate_global.h"
#include "graph/analysis/urgency.h"

namespace jarol::analysis {
namespace {

void measure(const TaskModels& models, const TimeLineLength& length, TimeLine& line) {
  double per_ns = 0;
  Duration offsets{};
  for (const TaskModel& m : models) {
    per_ns += 1 / static_cast<double>(m.period.count());
    offsets = std::max(offsets, m.offset);
  }
  const Duration round = hyperperiod(models, max_time / 8).value_or(max_time / 8);
  const bool twice = length.until_it_repeats && offsets > Duration{};
  const Duration whole = offsets + (twice ? 2 : 1) * round;
  const double filled = length.max_activations / per_ns;
  const bool fits = static_cast<double>(whole.count()) <= filled;
  line.until = fits ? whole : Duration(static_cast<std::int64_t>(filled));
  if (fits && (offsets == Duration{} || twice)) line.round = round;
}

}  // namespace

TimeLine time_line_of(const System& system, const Result& result, const TimeLineLength& length) {
  TimeLine line;
  if (system.models.empty()) return line;
  const Policy& policy = system.policy;
  measure(system.models, length, line);
  std::vector<std::size_t> all(system.models.size()), core(all.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  RunRules rules{.follows = system.follows, .order = std::vector<std::size_t>(all.size())};
  TaskModels models = system.models;
  if (policy.urgency == Urgency::turn) {
    // first come, first served: as if all had the same, long deadline
    for (TaskModel& m : models) m.deadline = max_time / 4;
    rules.order = system.turn;
  } else {
    all = in_order(system, std::move(all));
    for (std::size_t i = 0; i < all.size(); ++i) rules.order[all[i]] = i;
  }
  rules.by_order = policy.urgency == Urgency::priority;
  rules.preemptive = policy.interrupts;
  for (std::size_t i = 0; i < core.size(); ++i) core[i] = result.core[i].value_or(0);
  if (policy.keeps_core) rules.core = core;
  line.slices = slices_before(line.until, models, system.cores, rules);
  return line;
}

}  // namespace jarol::analysis
