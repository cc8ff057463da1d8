#include "graph/analysis/extremes.h"

#include <algorithm>
#include <tuple>

#include "graph/analysis/readiness.h"

namespace jarol::analysis {
namespace {

struct UrgentJob {
  std::int64_t urgency = 0;  // less first
  std::size_t task = 0;
  std::int64_t activation = 0;
  Duration arrival{};
  Duration left{};
  std::tuple<std::int64_t, std::size_t, std::int64_t> key() const { return {urgency, task, activation}; }
  bool operator>(const UrgentJob& other) const { return key() > other.key(); }
};

class Walker {
 public:
  Walker(const CoreTasks& tasks, Order order, bool beyond_late, Budget& budget)
      : tasks_(tasks),
        loads_(inheriting_loads(tasks)),
        order_(order),
        beyond_late_(beyond_late),
        budget_(budget),
        ready_at_(tasks) {
    result_.responses.resize(loads_.size());
    for (const TaskModel& m : loads_) {
      longest_jitter_ = std::max(longest_jitter_, m.jitter);
      last_offset_ = std::max(last_offset_, m.offset);
      if (std::find(blockings_.begin(), blockings_.end(), m.blocking) == blockings_.end())
        blockings_.push_back(m.blocking);
    }
  }

  Extremes run() {
    const auto lcm = hyperperiod(loads_, max_time / 8);
    if (!lcm) return std::move(result_);
    repetition_ = *lcm;
    const auto starts = latest_releases(last_offset_ + longest_jitter_ + *lcm);
    if (budget_.spent()) return std::move(result_);
    for (const Duration blocking : blockings_)
      for (const Duration start : starts)
        if (!walk_from(start, blocking)) return std::move(result_);
    result_.whole = !doubtful_;
    return std::move(result_);
  }

 private:
  // In order, each once.
  std::vector<Duration> latest_releases(Duration until) {
    std::vector<Duration> starts;
    for (std::size_t i = 0; i < loads_.size(); ++i)
      for (Duration a = loads_[i].offset; a < until && budget_.spend(10); a += loads_[i].period)
        starts.push_back(a + ready_at_(i, a).jitter);
    std::sort(starts.begin(), starts.end());
    starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
    return starts;
  }

  using Arrival = std::pair<Duration, std::size_t>;  // when, of which task

  UrgentJob job_at(const Arrival& a) const {
    const TaskModel& m = loads_[a.second];
    const std::int64_t urgency =
        order_ == Order::by_priority ? static_cast<std::int64_t>(a.second) : (a.first + m.deadline).count();
    return {urgency, a.second, (a.first - m.offset) / m.period, a.first, m.wcet};
  }

  // Held up for `blocking` at the start, of those activations that can be for so long. False if one is late, or there
  // is no more effort.
  bool walk_from(Duration start, Duration blocking) {
    // from then on each repetition leaves no more than the one before it
    const Duration end = start + last_offset_ + 2 * repetition_ + longest_jitter_;
    MinFirst<Arrival> arrivals;
    MinFirst<UrgentJob> ready;
    std::size_t open = 0;  // that arrived before the end
    const auto arrive = [&](const Arrival& a) {
      ready.push(job_at(a));
      open += a.first < end ? 1U : 0U;
    };
    for (std::size_t i = 0; i < loads_.size(); ++i) {
      const TaskModel& m = loads_[i];
      const Duration back = start - m.jitter - m.offset;
      Duration a = m.offset;
      if (back > Duration{}) a += m.period * static_cast<std::int64_t>(ceil_div(back.count(), m.period.count()));
      for (; a <= start; a += m.period)
        if (a + ready_at_(i, a).jitter >= start) arrive({a, i});
      arrivals.emplace(a, i);
    }
    if (!budget_.spend(loads_.size() * 4 + 10)) return false;
    std::vector<Slice> slices;
    result_.slices_from = result_.late ? result_.slices_from : Duration{};
    Duration now = start + blocking;
    while (now < end || open > 0) {
      while (arrivals.top().first <= now) {
        const Arrival a = arrivals.top();
        arrivals.pop();
        arrive(a);
        arrivals.emplace(a.first + loads_[a.second].period, a.second);
        if (!budget_.spend(10)) return false;
      }
      if (ready.empty()) return true;
      UrgentJob running = ready.top();
      ready.pop();
      const Duration stop = std::min(now + running.left, arrivals.top().first);
      add(slices, {running.task, running.activation, now, stop});
      running.left -= stop - now;
      now = stop;
      if (running.left > Duration{}) {
        ready.push(running);
        continue;
      }
      open -= running.arrival < end ? 1U : 0U;
      if (blocking <= blocking_of(running, start) && !close(running, now, blocking, slices)) return false;
    }
    result_.idle = false;
    return true;
  }

  void add(std::vector<Slice>& slices, const Slice& slice) {
    if (!slices.empty() && slices.back().task == slice.task && slices.back().activation == slice.activation &&
        slices.back().end == slice.begin) {
      slices.back().end = slice.end;
      return;
    }
    if (result_.late) return;
    if (slices.size() >= 2 * max_slices) drop_first(slices, max_slices, result_.slices_from);
    slices.push_back(slice);
  }

  // Under EDF what holds up one of an earlier deadline holds up those that wait behind it.
  Duration blocking_of(const UrgentJob& job, Duration start) const {
    if (order_ == Order::by_priority) return loads_[job.task].blocking;
    Duration max{};
    for (const TaskModel& m : loads_)
      if (m.deadline - m.jitter <= Duration(job.urgency) - start) max = std::max(max, m.blocking);
    return max;
  }

  bool close(const UrgentJob& job, Duration now, Duration blocking, std::vector<Slice>& slices) {
    result_.responses[job.task] = std::max(result_.responses[job.task], now - job.arrival);
    const Duration deadline = job.arrival + loads_[job.task].deadline;
    if (now <= deadline) return true;
    // for sure only by what holds itself up, or one of its instant that has not gone before it
    const Duration own = tasks_.models[job.task].blocking;
    const Duration sure = longest_jitter_ > Duration{} ? own : ready_at_(job.task, job.arrival).blocking;
    if (blocking > sure) return doubtful_ = true;
    if (!result_.late) {
      result_.late = DeadlineMiss{job.task, job.activation, job.arrival, now, deadline};
      result_.slices = std::move(slices);
    }
    return beyond_late_;
  }

  const CoreTasks& tasks_;
  TaskModels loads_;
  Order order_;
  bool beyond_late_;
  Budget& budget_;
  ReadinessAt ready_at_;
  bool doubtful_ = false;  // late by what another is held up for
  std::vector<Duration> blockings_;
  Duration longest_jitter_{}, last_offset_{}, repetition_{};
  Extremes result_;
};

}  // namespace

Extremes walk_extremes(const CoreTasks& tasks, Order order, bool beyond_late, Budget& budget) {
  constexpr std::uint64_t max_steps = 100'000'000;
  return within(budget, max_steps, [&](Budget& own) { return Walker(tasks, order, beyond_late, own).run(); });
}

}  // namespace jarol::analysis
