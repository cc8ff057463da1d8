#include "graph/analysis/edf_responses.h"

#include <algorithm>
#include <utility>

#include "graph/analysis/edf_demand.h"

namespace jarol::analysis {
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
      next += std::min<Wide>(by_time, releases_due(l, until)) * l.wcet;
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
  return points * n * n <= static_cast<long double>(std::min<std::uint64_t>(effort.left, most_edf_steps)) / 4;
}

}  // namespace

std::vector<std::int64_t> edf_responses(std::span<const Load> loads, bool preemptive, Effort& effort) {
  return within(effort, most_edf_steps, [&](Effort& own) -> std::vector<std::int64_t> {
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
  return within(effort, most_edf_steps, [&](Effort& own) {
    const auto busy = longest_busy(loads, preemptive, own);
    if (!busy || !is_quick(busy->second, loads.size(), own)) return false;
    const auto responses = responses_by_deadlines(loads, preemptive, busy->first, Count::sure, own);
    for (std::size_t i = 0; i < responses.size(); ++i)
      if (responses[i] > loads[i].deadline) return true;
    return false;
  });
}

}  // namespace jarol::analysis
