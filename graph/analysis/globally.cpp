// Global EDF: tasks on no core of their own.
#include <algorithm>

#include "graph/analysis/global_edf.h"
#include "graph/analysis/simulate_global.h"
#include "graph/analysis/systems.h"

namespace jarol::analysis {
namespace {

// What every activation may take of a core.
TaskModels with_blocking_in_wcet(TaskModels models) {
  for (TaskModel& m : models) {
    m.wcet += m.blocking;
    m.blocking = {};
  }
  return models;
}

// Upper bounds with readers that wait for those that they follow: their responses are jitter of the readers (as
// Tindell, Clark 1994), from none on, up to where they stay as they are. Nothing for one that none was found for.
std::vector<std::optional<Duration>> bounds_of(const System& system, const TaskModels& models, Budget& budget) {
  constexpr int max_rounds = 100;
  TaskModels waiting = models;
  for (int round = 0; round < max_rounds; ++round) {
    auto responses = global_edf_responses(waiting, system.cores, budget);
    bool changed = false;
    for (const auto& [producer, reader] : system.follows) {
      if (!responses[producer]) return std::vector<std::optional<Duration>>(models.size());
      changed = changed || *responses[producer] > waiting[reader].jitter;
      waiting[reader].jitter = std::max(waiting[reader].jitter, *responses[producer]);
    }
    if (!changed) return responses;
  }
  return std::vector<std::optional<Duration>>(models.size());
}

void refuse(Result& result, const GlobalSimulation& run, Evidence evidence) {
  if (result.verdict != Verdict::not_schedulable) {
    result.reason = "a task is late when every task takes its 'wcet'";
    result.evidence = evidence;
  }
  result.verdict = Verdict::not_schedulable;
  result.late = run.late;
  result.slices = run.slices;
  result.slices_from = run.slices_from;
}

// Runs that are possible: a late activation in one is a "no"; without jitter and with offsets that hold there is one
// only that is worst (Cucu, Goossens 2006; Ha, Liu 1994), so that it decides.
void walk(const System& system, const TaskModels& models, Result& result, Budget& budget) {
  // where the verdict stands, one that is late soon shows why
  const std::uint64_t max_activations = result.verdict == Verdict::not_schedulable ? 20'000 : 1'000'000;
  const std::uint64_t steps_of_activation = 40 + static_cast<std::uint64_t>(system.cores);
  const auto run_of = [&](const TaskModels& with, std::uint64_t max) {
    GlobalSimulation run = simulate_global(with, system.cores, std::min(max, budget.left / steps_of_activation),
                                           {.follows = system.follows});
    budget.spend(run.activations * steps_of_activation);
    return run;
  };
  const bool jitters =
      std::any_of(models.begin(), models.end(), [](const TaskModel& m) { return m.jitter > Duration{}; });
  const bool exact = system.offsets_hold && !jitters && system.follows.empty();
  const GlobalSimulation latest = run_of(models, max_activations);
  if (latest.late) return refuse(result, latest, exact ? Evidence::proof : Evidence::by_run);
  if (result.verdict == Verdict::not_schedulable) return;
  if (exact && latest.repeats) {
    result.verdict = Verdict::schedulable;
    result.evidence = Evidence::proof;
    result.reason =
        "every activation of the whole repetition ends by its deadline, where those of equal deadlines go in "
        "order of name";
    result.response.assign(latest.responses.begin(), latest.responses.end());
    result.exact.assign(models.size(), true);
    return;
  }
  TaskModels soonest = models;
  for (TaskModel& m : soonest) m.jitter = {};
  if (const GlobalSimulation run = run_of(soonest, max_activations); run.late)
    return refuse(result, run, Evidence::by_run);
  if (system.offsets_hold) return;
  // all at once, and all due at once
  for (const bool due : {false, true}) {
    TaskModels shifted = models;
    for (TaskModel& m : shifted) m.offset = due ? (m.period - m.deadline + m.jitter) % m.period : Duration{};
    if (const GlobalSimulation run = run_of(shifted, max_activations / 10); run.late && system.follows.empty())
      return refuse(result, run, Evidence::by_run);
  }
}

// On one core global EDF is EDF.
System with_edf(System system) {
  system.policy = policies::edf;
  return system;
}

}  // namespace

Result check_globally(const System& system, bool whole, Budget& budget) {
  constexpr std::uint64_t max_steps_to_bound = 50'000'000;
  if (system.cores == 1) return check_partitioned(with_edf(system), whole, budget);
  const TaskModels models = with_blocking_in_wcet(system.models);
  Result result;
  bool given_up = false;
  result.response = within(budget, max_steps_to_bound, [&](Budget& own) {
    auto bounds = bounds_of(system, models, own);
    given_up = own.spent();
    return bounds;
  });
  result.core.resize(models.size());
  const bool bounded =
      std::all_of(result.response.begin(), result.response.end(), [](const auto& r) { return r.has_value(); });
  const auto order = compare_utilisation(models, system.cores);
  if (order && *order > 0) {
    result.verdict = Verdict::not_schedulable;
    result.evidence = Evidence::proof;
    result.reason = "the tasks need more than all cores";
  } else if (bounded || (system.follows.empty() && passes_gfb(models, system.cores))) {
    result.verdict = Verdict::schedulable;
    result.evidence = Evidence::safe;
    result.reason = bounded ? "every task's response is bounded within its deadline (Bertogna, Cirinei)"
                            : "the densities fit the cores (Goossens, Funk, Baruah)";
    return result;
  } else {
    result.reason = given_up ? "bounds of the responses under global_edf were not found with the effort that is made"
                             : "the tests of global_edf are sufficient only, and none of them holds";
  }
  // each bound takes for granted that the other tasks end in time
  result.response.assign(models.size(), std::nullopt);
  if (result.verdict == Verdict::not_schedulable && !whole) return result;
  for (std::size_t i = 0; i < models.size(); ++i)
    if (models[i].jitter + models[i].wcet > models[i].deadline && result.verdict != Verdict::not_schedulable) {
      result.verdict = Verdict::not_schedulable;
      result.evidence = Evidence::proof;
      result.reason = "a task's 'wcet', 'blocking' and 'jitter' together are longer than its deadline";
    }
  walk(system, models, result, budget);
  return result;
}

}  // namespace jarol::analysis
