#include "graph/analysis/edf.h"

#include <algorithm>
#include <tuple>

namespace jarol::analysis {
namespace {

constexpr std::int64_t far = std::int64_t{1} << 61;
constexpr std::uint64_t most_steps = 50'000'000;

// Releases with a deadline within `length` of an arrival as late as jitter allows.
std::int64_t due(const Load& l, std::int64_t length) {
  const std::int64_t reach = length + l.jitter - l.deadline;
  return reach < 0 ? 0 : reach / l.period + 1;
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

// Length of the synchronous busy period, or nothing if it is longer than `most`.
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

}  // namespace

Wide demand_bound(std::span<const Load> loads, std::int64_t length) {
  Wide sum = 0;
  for (const Load& l : loads) sum += static_cast<Wide>(due(l, length)) * l.wcet;
  return sum;
}

namespace {

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
  return within(effort, most_steps, [&](Effort& own) {
    return preemptive ? check_edf_of(merged(loads), true, own) : check_edf_of(loads, false, own);
  });
}

namespace {

// With the longest `blocking` that may be felt and equal deadlines against the task, or what is sure.
enum class Count { most, sure };

// Of `own`, arriving so that it is released at `a` after the beginning of a busy period, at the latest.
std::optional<std::int64_t> response_at(std::span<const Load> loads, std::size_t own, std::int64_t a, bool preemptive,
                                        Count what, Effort& effort) {
  const Load& task = loads[own];
  const std::int64_t due_at = a - task.jitter + task.deadline;
  const Wide held = what == Count::most ? blocking_bound(loads, due_at, preemptive) : task.blocking;
  const Wide before = held + static_cast<Wide>(a / task.period) * task.wcet;
  // preemptive: up to its end; else up to its start, from where on nothing interrupts it
  std::int64_t length = preemptive ? task.wcet : 0;
  while (true) {
    Wide next = before + (preemptive ? task.wcet : 0);
    for (std::size_t j = 0; j < loads.size(); ++j) {
      const Load& l = loads[j];
      const std::int64_t until = what == Count::sure && j > own ? due_at - 1 : due_at;
      if (j == own || until - l.deadline + l.jitter < 0) continue;
      const Wide window = static_cast<Wide>(length) + l.jitter;
      const Wide by_time = preemptive ? ceil_div(window, l.period) : window / l.period + 1;
      next += std::min<Wide>(by_time, due(l, until)) * l.wcet;
    }
    if (!effort.spend(loads.size()) || next > far) return std::nullopt;
    if (next == length) break;
    length = static_cast<std::int64_t>(next);
  }
  return length + (preemptive ? 0 : task.wcet) - a + task.jitter;
}

// The longest over all releases in a busy period whose deadline coincides with that of another.
std::vector<std::int64_t> responses_by_deadlines(std::span<const Load> loads, bool preemptive, std::int64_t busy,
                                                 Count what, Effort& effort) {
  std::vector<std::int64_t> responses;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const Load& own = loads[i];
    std::int64_t response = own.wcet + own.jitter + own.blocking;
    for (const Load& other : loads) {
      const std::int64_t first = other.deadline - other.jitter - (own.deadline - own.jitter);
      for (std::int64_t k = first < 0 ? (-first + other.period - 1) / other.period : 0; k * other.period + first < busy;
           ++k) {
        const auto found = response_at(loads, i, k * other.period + first, preemptive, what, effort);
        if (!found) return {};
        response = std::max(response, *found);
      }
    }
    // what holds it up most may be what has a later deadline than the first ones
    const auto first = response_at(loads, i, 0, preemptive, what, effort);
    if (!first) return {};
    responses.push_back(std::max(response, *first));
  }
  return responses;
}

// An activation due `t` after the beginning of a busy period ends with the work that is due by then, and with the busy
// period: that much before its deadline.
std::vector<std::int64_t> responses_by_slack(std::span<const Load> loads, bool preemptive, std::int64_t busy,
                                             Effort& effort) {
  std::int64_t longest = 0;
  for (const Load& l : loads) longest = std::max(longest, l.deadline);
  std::vector<std::pair<std::int64_t, std::int64_t>> dues;  // when, how much
  std::vector<std::pair<std::int64_t, std::int64_t>> held;  // by how much up to when: non-preemptive
  std::int64_t blocking = 0;
  for (const Load& l : loads) {
    blocking = std::max(blocking, l.blocking);
    if (!preemptive) held.emplace_back(l.deadline - l.jitter, l.wcet - 1);
    for (std::int64_t t = l.deadline - l.jitter; t <= busy + longest; t += l.period) {
      if (!effort.spend(20)) return {};
      dues.emplace_back(std::max<std::int64_t>(0, t), l.wcet);
    }
  }
  std::sort(dues.begin(), dues.end());
  std::sort(held.begin(), held.end());
  for (std::size_t i = held.size(); i-- > 1;) held[i - 1].second = std::max(held[i - 1].second, held[i].second);
  // the least that is left from there on
  std::vector<std::pair<std::int64_t, std::int64_t>> left;
  Wide sum = 0;
  for (std::size_t i = 0; i < dues.size(); ++i) {
    sum += dues[i].second;
    if (i + 1 < dues.size() && dues[i + 1].first == dues[i].first) continue;
    const auto after = std::upper_bound(held.begin(), held.end(), std::pair(dues[i].first, far));
    const std::int64_t by = std::max(blocking, after == held.end() ? 0 : after->second);
    left.emplace_back(dues[i].first, dues[i].first - static_cast<std::int64_t>(std::min<Wide>(sum + by, busy)));
  }
  for (std::size_t i = left.size(); i-- > 1;) left[i - 1].second = std::min(left[i - 1].second, left[i].second);
  std::vector<std::int64_t> responses;
  for (const Load& l : loads) {
    const auto from =
        std::lower_bound(left.begin(), left.end(), std::pair(std::max<std::int64_t>(0, l.deadline - l.jitter), -far));
    const std::int64_t response = std::min(busy + l.jitter, l.deadline - from->second);
    responses.push_back(response);
  }
  return responses;
}

}  // namespace

namespace {

// How long a busy period lasts at most, and at how many instants in it something arrives; nothing if that is open.
std::optional<std::pair<std::int64_t, long double>> longest_busy(std::span<const Load> loads, bool preemptive,
                                                                 Effort& effort) {
  const auto order = compare_utilisation(loads, 1);
  if (!order || *order > 0 || loads.empty()) return std::nullopt;
  // from one hyperperiod to the next demand grows no more than time does
  const auto lcm = hyperperiod(loads, far / 4);
  std::int64_t blocking = 0, longest = 0;
  for (const Load& l : loads) {
    blocking = std::max({blocking, l.blocking, preemptive ? 0 : l.wcet - 1});
    longest = std::max(longest, l.deadline);
  }
  const std::int64_t most = lcm ? *lcm + longest : far / 2;
  std::optional<std::int64_t> busy;
  if (*order < 0 || blocking == 0) busy = busy_period(loads, blocking, most, effort);
  if (!busy && (!lcm || effort.spent())) return std::nullopt;
  const std::int64_t length = busy.value_or(most);
  long double points = 0;
  for (const Load& l : loads)
    points += static_cast<long double>(length + l.jitter) / static_cast<long double>(l.period) + 1;
  return std::pair(length, points);
}

bool is_quick(long double points, std::size_t tasks, const Effort& effort) {
  const auto n = static_cast<long double>(tasks);
  return points * n * n <= static_cast<long double>(std::min<std::uint64_t>(effort.left, most_steps)) / 4;
}

}  // namespace

std::vector<std::int64_t> edf_responses(std::span<const Load> loads, bool preemptive, Effort& effort) {
  return within(effort, most_steps, [&](Effort& own) -> std::vector<std::int64_t> {
    const auto busy = longest_busy(loads, preemptive, own);
    if (!busy) return {};
    if (is_quick(busy->second, loads.size(), own)) {
      auto responses = responses_by_deadlines(loads, preemptive, busy->first, Count::most, own);
      if (!responses.empty()) return responses;
    }
    return busy->second < 1e6L ? responses_by_slack(loads, preemptive, busy->first, own) : std::vector<std::int64_t>{};
  });
}

bool is_late_by_own_blocking(std::span<const Load> loads, bool preemptive, Effort& effort) {
  return within(effort, most_steps, [&](Effort& own) {
    const auto busy = longest_busy(loads, preemptive, own);
    if (!busy || !is_quick(busy->second, loads.size(), own)) return false;
    const auto responses = responses_by_deadlines(loads, preemptive, busy->first, Count::sure, own);
    for (std::size_t i = 0; i < responses.size(); ++i)
      if (responses[i] > loads[i].deadline) return true;
    return false;
  });
}

}  // namespace jarol::analysis
