#include "graph/analysis/edf_responses.h"

#include <algorithm>
#include <utility>

#include "graph/analysis/edf_demand.h"

namespace jarol::analysis {
namespace {

// With the longest `blocking` that may be felt and equal deadlines against the task, or what is sure.
enum class Count { max, sure };

// Of `own`, arriving so that it is released at `a` after the beginning of a busy period, at the latest.
std::optional<Duration> response_at(std::span<const TaskModel> models, std::size_t own, Duration a, bool preemptive,
                                    Count what, Budget& budget) {
  const TaskModel& task = models[own];
  const Duration due_at = a - task.jitter + task.deadline;
  const Duration held = what == Count::max ? blocking_bound(models, due_at, preemptive) : task.blocking;
  const Wide before = held.count() + static_cast<Wide>(a / task.period) * task.wcet.count();
  // preemptive: up to its end; else up to its start, from where on nothing interrupts it
  std::int64_t length = preemptive ? task.wcet.count() : 0;
  while (true) {
    Wide next = before + (preemptive ? task.wcet.count() : 0);
    for (std::size_t j = 0; j < models.size(); ++j) {
      const TaskModel& m = models[j];
      const Duration until = what == Count::sure && j > own ? due_at - Duration(1) : due_at;
      if (j == own || until - m.deadline + m.jitter < Duration{}) continue;
      const Wide window = static_cast<Wide>(length) + m.jitter.count();
      const Wide by_time = preemptive ? ceil_div(window, m.period.count()) : window / m.period.count() + 1;
      next += std::min<Wide>(by_time, releases_due(m, until)) * m.wcet.count();
    }
    if (!budget.spend(models.size()) || next > far.count()) return std::nullopt;
    if (next == length) break;
    length = static_cast<std::int64_t>(next);
  }
  return Duration(length) + (preemptive ? Duration{} : task.wcet) - a + task.jitter;
}

// The longest over all releases in a busy period whose deadline coincides with that of another.
std::vector<Duration> responses_by_deadlines(std::span<const TaskModel> models, bool preemptive, Duration busy,
                                             Count what, Budget& budget) {
  std::vector<Duration> responses;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const TaskModel& own = models[i];
    Duration response = own.wcet + own.jitter + own.blocking;
    for (const TaskModel& other : models) {
      const Duration first = other.deadline - other.jitter - (own.deadline - own.jitter);
      for (std::int64_t k = first < Duration{} ? (-first + other.period - Duration(1)) / other.period : 0;
           k * other.period + first < busy; ++k) {
        const auto found = response_at(models, i, k * other.period + first, preemptive, what, budget);
        if (!found) return {};
        response = std::max(response, *found);
      }
    }
    // what holds it up most may be what has a later deadline than the first ones
    const auto first = response_at(models, i, Duration{}, preemptive, what, budget);
    if (!first) return {};
    responses.push_back(std::max(response, *first));
  }
  return responses;
}

// An activation due `t` after the beginning of a busy period ends with the work that is due by then, and with the busy
// period: that much before its deadline.
std::vector<Duration> responses_by_slack(std::span<const TaskModel> models, bool preemptive, Duration busy,
                                         Budget& budget) {
  Duration longest{};
  for (const TaskModel& m : models) longest = std::max(longest, m.deadline);
  std::vector<std::pair<Duration, Duration>> dues;  // when, how much
  std::vector<std::pair<Duration, Duration>> held;  // by how much up to when: non-preemptive
  Duration blocking{};
  for (const TaskModel& m : models) {
    blocking = std::max(blocking, m.blocking);
    if (!preemptive) held.emplace_back(m.deadline - m.jitter, m.wcet - Duration(1));
    for (Duration t = m.deadline - m.jitter; t <= busy + longest; t += m.period) {
      if (!budget.spend(20)) return {};
      dues.emplace_back(std::max(Duration{}, t), m.wcet);
    }
  }
  std::sort(dues.begin(), dues.end());
  std::sort(held.begin(), held.end());
  for (std::size_t i = held.size(); i-- > 1;) held[i - 1].second = std::max(held[i - 1].second, held[i].second);
  // the least that is left from there on
  std::vector<std::pair<Duration, Duration>> left;
  Wide sum = 0;
  for (std::size_t i = 0; i < dues.size(); ++i) {
    sum += dues[i].second.count();
    if (i + 1 < dues.size() && dues[i + 1].first == dues[i].first) continue;
    const auto after = std::upper_bound(held.begin(), held.end(), std::pair(dues[i].first, far));
    const Duration by = std::max(blocking, after == held.end() ? Duration{} : after->second);
    left.emplace_back(dues[i].first, dues[i].first - std::min(saturated(sum + by.count()), busy));
  }
  for (std::size_t i = left.size(); i-- > 1;) left[i - 1].second = std::min(left[i - 1].second, left[i].second);
  std::vector<Duration> responses;
  for (const TaskModel& m : models) {
    const auto from =
        std::lower_bound(left.begin(), left.end(), std::pair(std::max(Duration{}, m.deadline - m.jitter), -far));
    const Duration response = std::min(busy + m.jitter, m.deadline - from->second);
    responses.push_back(response);
  }
  return responses;
}

// How long a busy period lasts at most, and at how many instants in it something arrives; nothing if that is open.
std::optional<std::pair<Duration, long double>> longest_busy(std::span<const TaskModel> models, bool preemptive,
                                                             Budget& budget) {
  const auto order = compare_utilisation(models, 1);
  if (!order || *order > 0 || models.empty()) return std::nullopt;
  // from one hyperperiod to the next demand grows no more than time does
  const auto lcm = hyperperiod(models, far / 4);
  Duration blocking{}, longest{};
  for (const TaskModel& m : models) {
    blocking = std::max({blocking, m.blocking, preemptive ? Duration{} : m.wcet - Duration(1)});
    longest = std::max(longest, m.deadline);
  }
  const Duration max = lcm ? *lcm + longest : far / 2;
  std::optional<Duration> busy;
  if (*order < 0 || blocking == Duration{}) busy = busy_period(models, blocking, max, budget);
  if (!busy && (!lcm || budget.spent())) return std::nullopt;
  const Duration length = busy.value_or(max);
  long double points = 0;
  for (const TaskModel& m : models)
    points += static_cast<long double>((length + m.jitter).count()) / static_cast<long double>(m.period.count()) + 1;
  return std::pair(length, points);
}

bool is_quick(long double points, std::size_t tasks, const Budget& budget) {
  const auto n = static_cast<long double>(tasks);
  return points * n * n <= static_cast<long double>(std::min<std::uint64_t>(budget.left, max_edf_steps)) / 4;
}

}  // namespace

std::vector<Duration> edf_responses(std::span<const TaskModel> models, bool preemptive, Budget& budget) {
  return within(budget, max_edf_steps, [&](Budget& own) -> std::vector<Duration> {
    const auto busy = longest_busy(models, preemptive, own);
    if (!busy) return {};
    if (is_quick(busy->second, models.size(), own)) {
      auto responses = responses_by_deadlines(models, preemptive, busy->first, Count::max, own);
      if (!responses.empty()) return responses;
    }
    return busy->second < 1e6L ? responses_by_slack(models, preemptive, busy->first, own) : std::vector<Duration>{};
  });
}

bool is_late_by_own_blocking(std::span<const TaskModel> models, bool preemptive, Budget& budget) {
  return within(budget, max_edf_steps, [&](Budget& own) {
    const auto busy = longest_busy(models, preemptive, own);
    if (!busy || !is_quick(busy->second, models.size(), own)) return false;
    const auto responses = responses_by_deadlines(models, preemptive, busy->first, Count::sure, own);
    for (std::size_t i = 0; i < responses.size(); ++i)
      if (responses[i] > models[i].deadline) return true;
    return false;
  });
}

}  // namespace jarol::analysis
