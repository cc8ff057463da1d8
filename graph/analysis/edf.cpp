#include "graph/analysis/edf.h"

#include <algorithm>
#include <tuple>

#include "graph/analysis/edf_demand.h"

namespace jarol::analysis {
namespace {

// A length beyond which demand can't exceed it, where utilisation is below one.
std::optional<std::int64_t> linear_bound(std::span<const Load> loads, std::int64_t blocking) {
  long double total = 0, sum = static_cast<long double>(blocking);
  std::int64_t latest = 0;
  for (const Load& l : loads) {
    const long double u = static_cast<long double>(l.wcet) / static_cast<long double>(l.period);
    total += u;
    sum += u * static_cast<long double>(std::max<std::int64_t>(0, l.period - l.deadline + l.jitter));
    latest = std::max(latest, l.deadline - l.jitter);
  }
  const long double slack = 1 - total;
  if (slack < 1e-15L) return std::nullopt;
  const long double bound = sum / slack * (1 + 1e-9L) + 1;
  if (bound > static_cast<long double>(far)) return std::nullopt;
  return std::max(latest, static_cast<std::int64_t>(bound)) + 1;
}

std::optional<std::int64_t> one_repetition(std::span<const Load> loads) {
  const auto lcm = hyperperiod(loads, far / 2);
  std::int64_t latest = 0;
  for (const Load& l : loads) latest = std::max(latest, l.deadline);
  return lcm ? std::optional(*lcm + latest) : std::nullopt;
}

std::optional<std::int64_t> least_of(std::optional<std::int64_t> a, std::optional<std::int64_t> b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

// The latest absolute deadline before `length`, or nothing.
std::optional<std::int64_t> deadline_before(std::span<const Load> loads, std::int64_t length) {
  std::optional<std::int64_t> latest;
  for (const Load& l : loads) {
    const std::int64_t first = std::max<std::int64_t>(0, l.deadline - l.jitter);
    if (first >= length) continue;
    // jitter may pull the first ones to 0
    const std::int64_t k = (length - 1 - (l.deadline - l.jitter)) / l.period;
    latest = std::max(latest.value_or(0), std::max<std::int64_t>(0, k * l.period + l.deadline - l.jitter));
  }
  return latest;
}

// As far as demand goes, tasks of equal timing are one.
Loads merged(std::span<const Load> loads) {
  Loads sorted(loads.begin(), loads.end());
  const auto timing = [](const Load& l) { return std::tuple(l.period, l.deadline, l.jitter, l.blocking); };
  std::sort(sorted.begin(), sorted.end(), [&](const Load& a, const Load& b) { return timing(a) < timing(b); });
  Loads result;
  for (const Load& l : sorted) {
    if (!result.empty() && timing(result.back()) == timing(l)) {
      result.back().wcet += l.wcet;
    } else {
      result.push_back(l);
    }
  }
  return result;
}

EdfResult check_edf_of(std::span<const Load> loads, bool preemptive, Effort& effort) {
  EdfResult result;
  const auto order = compare_utilisation(loads, 1);
  std::int64_t blocking = 0;
  for (const Load& l : loads) blocking = std::max({blocking, l.blocking, preemptive ? 0 : l.wcet - 1});
  std::optional<std::int64_t> end;
  if (order && *order <= 0) {
    // from one hyperperiod to the next demand grows no more than time does
    end = one_repetition(loads);
    if (*order < 0) end = least_of(end, linear_bound(loads, blocking));
    // close to full utilisation it may take very long to find the busy period: no further than it helps
    if (*order < 0 || blocking == 0) end = least_of(end, busy_period(loads, blocking, end.value_or(far), effort));
    if (end) *end += 1;
  } else if (order) {
    // demand grows beyond any line: look from short intervals on until it does
    std::int64_t length = 1;
    for (const Load& l : loads) length = std::max(length, l.deadline);
    while (length < far / 2 && demand_bound(loads, length) <= length) length *= 2;
    end = length + 1;
  }
  if (!end) return {false, std::nullopt};
  const auto total = [&](std::int64_t t) { return demand_bound(loads, t) + blocking_bound(loads, t, preemptive); };
  auto at = deadline_before(loads, *end);
  if (order && *order > 0 && demand_bound(loads, *end - 1) > *end - 1) at = *end - 1;
  while (at) {
    if (!effort.spend(loads.size())) return {false, std::nullopt};
    const Wide need = total(*at);
    if (need > *at) {
      const std::int64_t held = blocking_bound(loads, *at, preemptive);
      result.over = Demand{*at, static_cast<std::int64_t>(std::min<Wide>(need - held, far)), held};
      return result;
    }
    // shorter intervals have no more due, though perhaps more blocking: down to there none can exceed its length
    const Wide most = demand_bound(loads, *at) + blocking;
    at = deadline_before(loads, most < *at ? static_cast<std::int64_t>(most) + 1 : *at);
  }
  return result;
}

}  // namespace

EdfResult check_edf(std::span<const Load> loads, bool preemptive, Effort& effort) {
  return within(effort, most_edf_steps, [&](Effort& own) {
    return preemptive ? check_edf_of(merged(loads), true, own) : check_edf_of(loads, false, own);
  });
}

}  // namespace jarol::analysis
