#include "graph/analysis/time_table.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "graph/analysis/fifo_bound.h"
#include "graph/analysis/validate_table.h"

namespace jarol::analysis {
namespace {

constexpr std::size_t max_validated = 50'000;
constexpr std::uint64_t steps_of_walked = 10, max_after_late = 200'000;

struct TableJob {
  Duration arrival{};
  std::size_t turn = 0;  // among those that arrive at one instant
  std::size_t task = 0;
  std::int64_t activation = 0;
};

bool later(const TableJob& a, const TableJob& b) { return std::tie(a.arrival, a.turn) > std::tie(b.arrival, b.turn); }

// What every activation may take of its core.
TaskModels with_blocking(TaskModels models) {
  for (TaskModel& m : models) m.wcet += m.blocking;
  return models;
}

// Does any core have more to do than there is time?
bool overloaded(const System& system, const std::vector<std::size_t>& core) {
  std::vector<TaskModels> of_core(static_cast<std::size_t>(system.cores));
  for (std::size_t i = 0; i < system.models.size(); ++i) of_core[core[i]].push_back(system.models[i]);
  return std::any_of(of_core.begin(), of_core.end(), [](const TaskModels& models) {
    const auto order = compare_utilisation(with_blocking(models), 1);
    return order && *order > 0;
  });
}

class TableWalk {
 public:
  TableWalk(const System& system, const std::vector<std::size_t>& core)
      : system_(system),
        core_(core),
        producers_(system.models.size()),
        arrived_(system.models.size(), Duration(-1)),
        ended_(system.models.size()),
        free_(static_cast<std::size_t>(system.cores)),
        jobs_(&later) {
    responses.resize(system.models.size());
    for (const auto& [producer, reader] : system.follows)
      if (core[producer] != core[reader]) producers_[reader].push_back(producer);
    for (std::size_t i = 0; i < system.models.size(); ++i) jobs_.push({system.models[i].offset, system.turn[i], i, 0});
  }

  // All that arrive before `end`; false when one is late for the first time or there are more than `max`.
  bool run_until(Duration end, std::uint64_t max) {
    const bool on_time = !late;
    while (!jobs_.empty() && jobs_.top().arrival < end) {
      if (activations >= max) return false;
      ++activations;
      run_next();
      if (late && (on_time || latest_ > max_time)) return false;
    }
    return true;
  }

  // How much longer than that instant each core has to do.
  std::vector<Duration> backlog(Duration instant) const {
    std::vector<Duration> left;
    for (const Duration f : free_) left.push_back(std::max(Duration{}, f - instant));
    return left;
  }

  std::uint64_t activations = 0;
  std::optional<DeadlineMiss> late;
  std::vector<Duration> responses;
  std::vector<Slice> slices;  // all, as far as they are to be validated
  std::vector<Slice> recent;  // those after
  Duration slices_from{};

 private:
  void run_next() {
    TableJob job = jobs_.top();
    jobs_.pop();
    const TaskModel& model = system_.models[job.task];
    Duration& free = free_[core_[job.task]];
    Duration start = std::max(free, job.arrival + model.jitter);
    for (const std::size_t p : producers_[job.task])
      if (arrived_[p] == job.arrival) start = std::max(start, ended_[p]);
    const Duration finish = start + model.blocking + model.wcet;
    free = ended_[job.task] = finish;
    latest_ = std::max(latest_, finish);
    arrived_[job.task] = job.arrival;
    responses[job.task] = std::max(responses[job.task], finish - job.arrival);
    if (!late) (slices.size() < max_validated ? slices : recent).push_back({job.task, job.activation, start, finish});
    if (recent.size() >= 2 * max_slices) drop_first(recent, max_slices, slices_from);
    if (finish > job.arrival + model.deadline && !late)
      late = DeadlineMiss{job.task, job.activation, job.arrival, finish, job.arrival + model.deadline};
    job.arrival += model.period;
    ++job.activation;
    jobs_.push(job);
  }

  const System& system_;
  const std::vector<std::size_t>& core_;
  std::vector<std::vector<std::size_t>> producers_;  // on other cores
  std::vector<Duration> arrived_, ended_, free_;
  Duration latest_{};
  std::priority_queue<TableJob, std::vector<TableJob>, decltype(&later)> jobs_;
};

CoreResult result_of(Verdict verdict, Evidence evidence, std::string reason, std::size_t tasks) {
  CoreResult result;
  result.verdict = verdict;
  result.evidence = evidence;
  result.reason = std::move(reason);
  result.responses.resize(tasks);
  return result;
}

// Activations of so many repetitions.
double activations_of(const System& system, Duration time) {
  double count = 0;
  for (const TaskModel& m : system.models)
    count += static_cast<double>(time.count()) / static_cast<double>(m.period.count());
  return count;
}

// The walk up to the repetition, within `max` activations; the reason stays empty where that ended it. `whole`: on
// after the first late one, as far as that is not far.
CoreResult walk(const System& system, const std::vector<std::size_t>& core, std::optional<Duration> lcm, bool whole,
                Budget& budget, std::uint64_t max) {
  TableWalk table(system, core);
  CoreResult result = result_of(Verdict::unknown, Evidence::none, "", system.models.size());
  Duration end{};
  for (const TaskModel& m : system.models) end = std::max(end, m.offset);
  const auto run = [&] {
    if (table.run_until(end, max)) return true;
    if (!table.late || !whole) return false;
    max = std::min(max, table.activations + max_after_late);
    return table.run_until(end, max);
  };
  const std::int64_t repetitions = system.cores + 2;
  bool on = run(), repeats = false, grows = false;
  std::vector<Duration> before = table.backlog(end);
  for (std::int64_t k = 0; on && !repeats; ++k) {
    if (lcm && end > max_time - *lcm) break;
    end = lcm ? end + *lcm : max_time;
    on = run();
    if (!on || !lcm) break;
    std::vector<Duration> now = table.backlog(end);
    repeats = now == before;
    if (k >= repetitions && !repeats && !grows) {
      grows = true;
      max = std::min(max, table.activations + max_after_late);
      if (table.late) break;
    }
    before = std::move(now);
  }
  budget.spend(table.activations * steps_of_walked);
  if (repeats) result.responses.assign(table.responses.begin(), table.responses.end());
  result.exact = repeats;
  if (table.late || grows) {
    result.verdict = Verdict::not_schedulable;
    result.evidence = Evidence::proof;
    result.reason = grows && system.cores > 1
                        ? "waiting for other cores takes longer than there is time: the backlog grows"
                        : "a task is late when every task takes its 'wcet'";
    result.late = table.late;
    // the last ones report why
    result.slices = std::move(table.slices);
    result.slices.insert(result.slices.end(), table.recent.begin(), table.recent.end());
    result.slices_from = table.slices_from;
    if (result.slices.size() > max_slices)
      drop_first(result.slices, result.slices.size() - max_slices, result.slices_from);
    return result;
  }
  if (!repeats) return result;
  const std::string fault =
      table.recent.empty() ? fault_of_table(system, core, std::move(table.slices), end, lcm.value_or(end)) : "";
  if (!fault.empty()) {
    result.reason = "the table that was found is wrong, please report this: " + fault;
    return result;
  }
  result.verdict = Verdict::schedulable;
  result.evidence = Evidence::proof;
  result.reason = "every job of the time table ends by its deadline";
  return result;
}

}  // namespace

CoreResult check_table(const System& system, const std::vector<std::size_t>& core, bool whole, Budget& budget,
                       std::uint64_t max) {
  const std::size_t n = system.models.size();
  if (!system.offsets_hold)
    return result_of(Verdict::unknown, Evidence::none, "a table needs offsets that hold; 'phasing: any' has none", n);
  const auto lcm = hyperperiod(system.models, max_time / 4);
  max = std::min(max, budget.left / steps_of_walked);
  if (overloaded(system, core)) {
    // a late one shows why, where there is one soon
    CoreResult result = walk(system, core, lcm, false, budget, std::min<std::uint64_t>(max, 1'000'000));
    result.verdict = Verdict::not_schedulable;
    result.evidence = Evidence::proof;
    result.reason = "the tasks need more than the whole core";
    return result;
  }
  // a bound before a walk that leads to no end
  if (!lcm || activations_of(system, 2 * *lcm) > static_cast<double>(max)) {
    auto bounds = fifo_bounds(system, core, budget);
    if (!bounds.empty()) {
      CoreResult result = result_of(Verdict::schedulable, Evidence::safe,
                                    "whatever may stand before a task in the table, it ends by its deadline", n);
      result.responses.assign(bounds.begin(), bounds.end());
      return result;
    }
  }
  CoreResult result = walk(system, core, lcm, whole, budget, max);
  if (result.reason.empty()) {
    const bool long_periods = !lcm || activations_of(system, *lcm) > static_cast<double>(max);
    result.reason = (long_periods ? "the periods repeat" : "all that the offsets lead to is seen to repeat") +
                    (" only after more than " + std::to_string(max)) + " activations, and none of these is late";
  }
  return result;
}

}  // namespace jarol::analysis
