#include "graph/analysis/simulate_global.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

namespace jarol::analysis {
namespace {

constexpr std::size_t max_slices_of_cores = 400;

struct Job {
  Duration urgency{};     // less first
  std::size_t order = 0;  // of equals
  std::size_t task = 0;
  std::int64_t activation = 0;
  Duration arrival{};
  Duration deadline{};
  Duration left{};
  bool started = false;
  std::size_t slice = 0;  // the number of its newest one, from 1 on; 0: none
};

bool more_urgent(const Job& a, const Job& b) {
  return std::tie(a.urgency, a.order, a.activation) < std::tie(b.urgency, b.order, b.activation);
}

class Simulator {
 public:
  Simulator(std::span<const TaskModel> models, std::int64_t cores, const RunRules& rules)
      : loads_(models), cores_(static_cast<std::size_t>(cores)), rules_(rules), producers_(models.size()) {
    result_.responses.resize(models.size());
    for (std::size_t i = 0; i < models.size(); ++i) arrivals_.emplace(models[i].offset + models[i].jitter, i);
    for (const auto& [producer, reader] : rules.follows) producers_[reader].push_back(producer);
    released_.resize(models.size(), 0);
    ended_.resize(models.size(), 0);
  }

  // False if an activation is late, or there are too many.
  bool run_until(Duration end, std::uint64_t max_activations) {
    while (now_ < end) {
      if (result_.activations > max_activations) return false;
      arrive();
      choose();
      Duration next = std::min(end, arrivals_.top().first);
      for (const std::size_t i : running_) next = std::min(next, now_ + ready_[i].left);
      for (const std::size_t i : running_) advance(ready_[i], next);
      now_ = next;
      for (std::size_t k = running_.size(); k-- > 0;)
        if (ready_[running_[k]].left == Duration{} && !close(running_[k])) return false;
    }
    return true;
  }

  // Work that is left of each task: with deadlines within periods and nothing late, all that the future depends on.
  // Nothing if something is late already and has yet to end.
  std::optional<std::vector<Duration>> left() const {
    std::vector<Duration> sum(loads_.size());
    for (const Job& job : ready_) {
      if (job.deadline <= now_) return std::nullopt;
      sum[job.task] += job.left;
    }
    return sum;
  }

  GlobalSimulation& result() { return result_; }

 private:
  void arrive() {
    while (arrivals_.top().first <= now_) {
      const std::size_t i = arrivals_.top().second;
      arrivals_.pop();
      const Duration arrival = now_ - loads_[i].jitter;
      const Duration deadline = arrival + loads_[i].deadline;
      const std::size_t order = rules_.order.empty() ? i : rules_.order[i];
      const Job job{
          rules_.by_order ? Duration{} : deadline, order, i, released_[i]++, arrival, deadline, loads_[i].wcet, false};
      ready_.insert(std::upper_bound(ready_.begin(), ready_.end(), job, more_urgent), job);
      arrivals_.emplace(now_ + loads_[i].period, i);
      ++result_.activations;
    }
  }

  // Has an activation that it follows yet to end?
  bool waits(const Job& job) const {
    return std::any_of(producers_[job.task].begin(), producers_[job.task].end(), [&](std::size_t p) {
      const Duration since = job.arrival - loads_[p].offset;
      return since >= Duration{} && since % loads_[p].period == Duration{} && ended_[p] <= since / loads_[p].period;
    });
  }

  void choose() {
    running_.clear();
    if (rules_.core.empty()) {
      for (std::size_t i = 0; i < ready_.size() && running_.size() < cores_; ++i)
        if (!waits(ready_[i])) running_.push_back(i);
      return;
    }
    taken_.assign(cores_, false);
    const auto take = [&](std::size_t i) {
      if (taken_[rules_.core[ready_[i].task]]) return;
      taken_[rules_.core[ready_[i].task]] = true;
      ready_[i].started = true;
      running_.push_back(i);
    };
    for (std::size_t i = 0; i < ready_.size() && !rules_.preemptive; ++i)
      if (ready_[i].started) take(i);
    for (std::size_t i = 0; i < ready_.size() && running_.size() < cores_; ++i)
      if (!waits(ready_[i])) take(i);
    std::sort(running_.begin(), running_.end());
  }

  void advance(Job& job, Duration until) {
    job.left -= until - now_;
    std::vector<Slice>& slices = result_.slices;
    if (job.slice > dropped_ && slices[job.slice - dropped_ - 1].end == now_) {
      slices[job.slice - dropped_ - 1].end = until;
      return;
    }
    if (slices.size() >= 2 * max_slices_of_cores) {
      drop_first(slices, max_slices_of_cores, result_.slices_from);
      dropped_ += max_slices_of_cores;
    }
    slices.push_back({job.task, job.activation, now_, until});
    job.slice = dropped_ + slices.size();
  }

  bool close(std::size_t i) {
    const Job job = ready_[i];
    ready_.erase(ready_.begin() + static_cast<std::ptrdiff_t>(i));
    ++ended_[job.task];
    result_.responses[job.task] = std::max(result_.responses[job.task], now_ - job.arrival);
    if (now_ <= job.deadline) return true;
    result_.late = DeadlineMiss{job.task, job.activation, job.arrival, now_, job.deadline};
    return false;
  }

  std::span<const TaskModel> loads_;
  std::size_t cores_;
  const RunRules& rules_;
  Duration now_{};
  using Arrival = std::pair<Duration, std::size_t>;  // when, which task
  std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> arrivals_;
  std::vector<std::vector<std::size_t>> producers_;
  std::vector<std::int64_t> released_, ended_;  // per task, how many
  std::vector<std::size_t> running_;            // of ready_
  std::vector<bool> taken_;                     // per core
  std::vector<Job> ready_;                      // most urgent first
  std::size_t dropped_ = 0;                     // slices that are kept no more
  GlobalSimulation result_;
};

}  // namespace

GlobalSimulation simulate_global(std::span<const TaskModel> models, std::int64_t cores, std::uint64_t max_activations,
                                 const RunRules& rules) {
  Simulator simulator(models, cores, rules);
  const auto lcm = hyperperiod(models, max_time / 4);
  Duration end{};
  for (const TaskModel& m : models) end = std::max(end, m.offset + m.jitter);
  bool on = !models.empty() && simulator.run_until(end, max_activations);
  auto before = simulator.left();
  while (on) {
    end = lcm ? end + *lcm : max_time;
    if (end > max_time || !simulator.run_until(end, max_activations) || !lcm) break;
    const auto after = simulator.left();
    simulator.result().repeats = after && after == before;
    on = !simulator.result().repeats;
    before = after;
  }
  return std::move(simulator.result());
}

std::vector<Slice> slices_before(Duration until, std::span<const TaskModel> models, std::int64_t cores,
                                 const RunRules& rules) {
  if (models.empty()) return {};
  Simulator simulator(models, cores, rules);
  simulator.run_until(until, std::numeric_limits<std::uint64_t>::max());
  return std::move(simulator.result().slices);
}

}  // namespace jarol::analysis
