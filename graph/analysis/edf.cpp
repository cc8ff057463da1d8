#include "graph/analysis/edf.h"

#include <algorithm>
#include <tuple>

#include "graph/analysis/edf_demand.h"

namespace jarol::analysis {
namespace {

// A length beyond which demand can't exceed it, where utilisation is below one.
std::optional<Duration> linear_bound(std::span<const TaskModel> models, Duration blocking) {
  long double total = 0, sum = static_cast<long double>(blocking.count());
  Duration latest{};
  for (const TaskModel& m : models) {
    const long double u = static_cast<long double>(m.wcet.count()) / static_cast<long double>(m.period.count());
    total += u;
    sum += u * static_cast<long double>(std::max(Duration{}, m.period - m.deadline + m.jitter).count());
    latest = std::max(latest, m.deadline - m.jitter);
  }
  const long double slack = 1 - total;
  if (slack < 1e-15L) return std::nullopt;
  const long double bound = sum / slack * (1 + 1e-9L) + 1;
  if (bound > static_cast<long double>(far.count())) return std::nullopt;
  return std::max(latest, Duration(static_cast<std::int64_t>(bound))) + Duration(1);
}

std::optional<Duration> one_repetition(std::span<const TaskModel> models) {
  const auto lcm = hyperperiod(models, far / 2);
  Duration latest{};
  for (const TaskModel& m : models) latest = std::max(latest, m.deadline);
  return lcm ? std::optional(*lcm + latest) : std::nullopt;
}

std::optional<Duration> min_of(std::optional<Duration> a, std::optional<Duration> b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

// The latest absolute deadline before `length`, or nothing.
std::optional<Duration> deadline_before(std::span<const TaskModel> models, Duration length) {
  std::optional<Duration> latest;
  for (const TaskModel& m : models) {
    const Duration first = std::max(Duration{}, m.deadline - m.jitter);
    if (first >= length) continue;
    // jitter may pull the first ones to 0
    const std::int64_t k = (length - Duration(1) - (m.deadline - m.jitter)) / m.period;
    latest = std::max(latest.value_or(Duration{}), std::max(Duration{}, k * m.period + m.deadline - m.jitter));
  }
  return latest;
}

// As far as demand goes, tasks of equal timing are one. Beyond full utilisation their WCETs may be no time that there
// is.
TaskModels merged(std::span<const TaskModel> models) {
  TaskModels sorted(models.begin(), models.end());
  const auto timing = [](const TaskModel& m) { return std::tuple(m.period, m.deadline, m.jitter, m.blocking); };
  std::sort(sorted.begin(), sorted.end(),
            [&](const TaskModel& a, const TaskModel& b) { return timing(a) < timing(b); });
  TaskModels result;
  for (const TaskModel& m : sorted) {
    if (!result.empty() && timing(result.back()) == timing(m)) {
      result.back().wcet = saturated(static_cast<Wide>(result.back().wcet.count()) + m.wcet.count());
    } else {
      result.push_back(m);
    }
  }
  return result;
}

// `order`: of utilisation and one.
EdfResult check_edf_of(std::span<const TaskModel> models, std::optional<std::strong_ordering> order, bool preemptive,
                       Budget& budget) {
  EdfResult result;
  Duration blocking{};
  for (const TaskModel& m : models)
    blocking = std::max({blocking, m.blocking, preemptive ? Duration{} : m.wcet - Duration(1)});
  std::optional<Duration> end;
  if (order && *order <= 0) {
    // from one hyperperiod to the next demand grows no more than time does
    end = one_repetition(models);
    if (*order < 0) end = min_of(end, linear_bound(models, blocking));
    // close to full utilisation it may take very long to find the busy period: no further than it helps
    if (*order < 0 || blocking == Duration{})
      end = min_of(end, busy_period(models, blocking, end.value_or(far), budget));
    if (end) *end += Duration(1);
  } else if (order) {
    // demand grows beyond any line: look from short intervals on until it does
    Duration length(1);
    for (const TaskModel& m : models) length = std::max(length, m.deadline);
    while (length < far / 2 && demand_bound(models, length) <= length.count()) length *= 2;
    end = length + Duration(1);
  }
  if (!end) return {false, std::nullopt};
  const auto total = [&](Duration t) {
    return demand_bound(models, t) + blocking_bound(models, t, preemptive).count();
  };
  auto at = deadline_before(models, *end);
  if (order && *order > 0) {
    const Duration last = *end - Duration(1);
    if (demand_bound(models, last) > last.count()) at = last;
  }
  while (at) {
    if (!budget.spend(models.size())) return {false, std::nullopt};
    const Wide need = total(*at);
    if (need > at->count()) {
      const Duration held = blocking_bound(models, *at, preemptive);
      result.over = Demand{*at, saturated(need - held.count()), held};
      return result;
    }
    // shorter intervals have no more due, though perhaps more blocking: down to there none can exceed its length
    const Wide max = demand_bound(models, *at) + blocking.count();
    at = deadline_before(models, max < at->count() ? Duration(static_cast<std::int64_t>(max) + 1) : *at);
  }
  return result;
}

}  // namespace

EdfResult check_edf(std::span<const TaskModel> models, bool preemptive, Budget& budget) {
  return within(budget, max_edf_steps, [&](Budget& own) {
    const auto order = compare_utilisation(models, 1);
    EdfResult result =
        preemptive ? check_edf_of(merged(models), order, true, own) : check_edf_of(models, order, false, own);
    if (result.over)
      for (const TaskModel& m : models) result.over->releases.push_back(releases_due(m, result.over->length));
    return result;
  });
}

}  // namespace jarol::analysis
