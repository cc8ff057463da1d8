#include "distributers/session/measure.h"

#include <algorithm>
#include <cmath>

#include "graph/text/errors.h"
#include "runtime/execute/executor.h"
#include "runtime/machine/thread_time.h"

namespace jarol {
namespace {

Duration length_of_missions(const Loaded& loaded) {
  Duration end{};
  for (const auto& system : loaded.systems) end = std::max(end, system->end().value_or(Duration{}));
  return end > Duration{} ? end : std::chrono::seconds(10);
}

void require_in_process(const Loaded& loaded) {
  if (const Distributer* distributer = find_in_real_time(loaded))
    throw InputError("distributer '" + distributer->name +
                     "' has a link to what goes on by itself, from which nothing comes while tasks are "
                     "measured; choose a link in process, as simulation or script");
}

// What lengthens an activation once in a while: an interrupt, cold caches, a page. It hit some task while these were
// measured, and may hit any other the next time.
Duration longest_disturbance(const Measurement& measurement) {
  Duration longest{};
  for (const MeasuredTask& task : measurement.tasks) longest = std::max(longest, task.max - task.max_of_999);
  return longest;
}

}  // namespace

Measurement measure_tasks(Loaded& loaded, std::optional<Duration> end) {
  require_in_process(loaded);
  const Duration over = end ? *end : length_of_missions(loaded);
  if (thread_time_between_readings() == Duration{})
    throw Unfinished(
        "this machine's clock of a thread's own time is too coarse to measure tasks; state their 'wcet' yourself");
  // a vehicle in lockstep is connected to; they do not finish, for what that keeps is for the next run
  for (const auto& system : loaded.systems) system->begin();
  Executor executor(*loaded.graph, std::move(loaded.systems),
                    {.digest = false, .recorder = nullptr, .sharing = Sharing::measure});
  executor.run_until(over);
  if (executor.report().stopped)
    throw InputError("nothing was measured, as a fault stopped the run: " + to_text(executor.report().faults.front()));
  Measurement measured{over, {}, executor.report()};
  for (std::size_t i = 0; i < loaded.graph->tasks.size(); ++i) {
    const Histogram& took = executor.team()->took(i);
    measured.tasks.push_back({took.count(), took.max(), took.percentile(0.999)});
  }
  return measured;
}

const Task* longer_than_stated(const Graph& graph, const Measurement& measurement) {
  const Task* worst = nullptr;
  Duration max_over{};
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const Task& task = graph.tasks[i];
    const Duration over = task.wcet ? measurement.tasks[i].max - *task.wcet : Duration{};
    if (over <= max_over) continue;
    max_over = over;
    worst = &task;
  }
  return worst;
}

Duration with_margin(Duration max, double margin) {
  auto ns = static_cast<std::int64_t>(std::ceil(static_cast<double>(max.count()) * (1 + margin)));
  std::int64_t step = 1;
  while (ns / step >= 1000) step *= 10;
  ns = (ns + step - 1) / step * step;
  return Duration(std::max<std::int64_t>(1, ns));
}

std::vector<ChosenWcet> choose_wcets(const Graph& measured, const Measurement& measurement, const Graph& in_file,
                                     double margin, bool lower) {
  const Duration met = longest_disturbance(measurement), expected = std::max(met, min_disturbance);
  std::vector<ChosenWcet> all(measured.tasks.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const MeasuredTask& took = measurement.tasks[i];
    const auto wcet_with = [&](Duration disturbance) {
      return with_margin(std::max(took.max, took.max_of_999 + disturbance), margin);
    };
    const auto task = std::find_if(in_file.tasks.begin(), in_file.tasks.end(),
                                   [&](const Task& t) { return t.name == measured.tasks[i].name; });
    if (task == in_file.tasks.end()) continue;
    ChosenWcet& chosen = all[i];
    chosen.stated = task->wcet;
    if (took.activations == 0) continue;
    const Duration wcet = wcet_with(expected);
    // one that is stated need not have room for what was not met
    chosen.kept = chosen.stated && *chosen.stated >= wcet_with(met) && (!lower || *chosen.stated <= wcet);
    if (!chosen.kept) chosen.written = wcet;
  }
  return all;
}

}  // namespace jarol
