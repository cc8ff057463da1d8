#include "graph/analysis/time_line.h"

#include <algorithm>
#include <numeric>

#include "graph/analysis/simulate_global.h"
#include "graph/analysis/urgency.h"

namespace jarol::analysis {
namespace {

constexpr double most_drawn = 300;

std::int64_t length_of(const Loads& loads) {
  double per_ns = 0;
  std::int64_t offsets = 0;
  for (const Load& l : loads) {
    per_ns += 1 / static_cast<double>(l.period);
    offsets = std::max(offsets, l.offset);
  }
  const std::int64_t whole = offsets + hyperperiod(loads, most_time / 4).value_or(most_time / 4);
  const double filled = most_drawn / per_ns;
  return static_cast<double>(whole) <= filled ? whole : static_cast<std::int64_t>(filled);
}

}  // namespace

TimeLine time_line_of(const System& system, const Result& result) {
  TimeLine line;
  if (system.loads.empty()) return line;
  const Policy& policy = system.policy;
  line.until = length_of(system.loads);
  std::vector<std::size_t> all(system.loads.size()), core(all.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  RunRules rules{.follows = system.follows, .order = std::vector<std::size_t>(all.size())};
  Loads loads = system.loads;
  if (policy.urgency == Urgency::turn) {
    // first come, first served: as if all had the same, long deadline
    for (Load& l : loads) l.deadline = most_time / 4;
    rules.order = system.turn;
  } else {
    all = in_order(system, std::move(all));
    for (std::size_t i = 0; i < all.size(); ++i) rules.order[all[i]] = i;
  }
  rules.by_order = policy.urgency == Urgency::priority;
  rules.preemptive = policy.interrupts;
  for (std::size_t i = 0; i < core.size(); ++i) core[i] = result.core[i].value_or(0);
  if (policy.keeps_core) rules.core = core;
  line.slices = slices_before(line.until, loads, system.cores, rules);
  return line;
}

}  // namespace jarol::analysis
