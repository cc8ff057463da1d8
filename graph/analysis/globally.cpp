// Global EDF: tasks on no core of their own.
#include <algorithm>

#include "graph/analysis/global_edf.h"
#include "graph/analysis/simulate_global.h"
#include "graph/analysis/systems.h"

namespace jarol::analysis {
namespace {

// What every activation may take of a core.
Loads with_blocking_in_wcet(Loads loads) {
  for (Load& l : loads) {
    l.wcet += l.blocking;
    l.blocking = 0;
  }
  return loads;
}

// Upper bounds with readers that wait for those that they follow: their responses are jitter of the readers (as
// Tindell, Clark 1994), from none on, up to where they stay as they are. Nothing for one that none was found for.
std::vector<std::optional<std::int64_t>> bounds_of(const System& system, const Loads& loads) {
  constexpr int most_rounds = 100;
  Loads waiting = loads;
  for (int round = 0; round < most_rounds; ++round) {
    auto responses = global_edf_responses(waiting, system.cores);
    bool changed = false;
    for (const auto& [producer, reader] : system.follows) {
      if (!responses[producer]) return std::vector<std::optional<std::int64_t>>(loads.size());
      changed = changed || *responses[producer] > waiting[reader].jitter;
      waiting[reader].jitter = std::max(waiting[reader].jitter, *responses[producer]);
    }
    if (!changed) return responses;
  }
  return std::vector<std::optional<std::int64_t>>(loads.size());
}

void refuse(Result& result, const GlobalSimulation& run, Standing standing) {
  if (result.verdict != Verdict::not_schedulable) {
    result.reason = "a task is late when every task takes its 'wcet'";
    result.standing = standing;
  }
  result.verdict = Verdict::not_schedulable;
  result.late = run.late;
  result.slices = run.slices;
}

// Runs that are possible: a late activation in one is a "no"; without jitter and with offsets that hold there is one
// only that is worst (Cucu, Goossens 2006; Ha, Liu 1994), so that it decides.
void walk(const System& system, const Loads& loads, Result& result, Effort& effort) {
  constexpr std::uint64_t most_activations = 1'000'000, steps_of_activation = 40;
  const auto run_of = [&](const Loads& with, std::uint64_t most) {
    GlobalSimulation run = simulate_global(with, system.cores, std::min(most, effort.left / steps_of_activation),
                                           {.follows = system.follows});
    effort.spend(run.activations * steps_of_activation);
    return run;
  };
  const bool jitters = std::any_of(loads.begin(), loads.end(), [](const Load& l) { return l.jitter > 0; });
  const bool exact = system.offsets_hold && !jitters && system.follows.empty();
  const GlobalSimulation latest = run_of(loads, most_activations);
  if (latest.late) return refuse(result, latest, exact ? Standing::proof : Standing::by_run);
  if (result.verdict == Verdict::not_schedulable) return;
  if (exact && latest.repeats) {
    result.verdict = Verdict::schedulable;
    result.standing = Standing::proof;
    result.reason =
        "every activation of the whole repetition ends by its deadline, where those of equal deadlines go in "
        "order of name";
    result.response.assign(latest.responses.begin(), latest.responses.end());
    result.exact.assign(loads.size(), true);
    return;
  }
  Loads soonest = loads;
  for (Load& l : soonest) l.jitter = 0;
  if (const GlobalSimulation run = run_of(soonest, most_activations); run.late)
    return refuse(result, run, Standing::by_run);
  if (system.offsets_hold) return;
  // all at once, and all due at once
  for (const bool due : {false, true}) {
    Loads shifted = loads;
    for (Load& l : shifted) l.offset = due ? (l.period - l.deadline + l.jitter) % l.period : 0;
    if (const GlobalSimulation run = run_of(shifted, most_activations / 10); run.late && system.follows.empty())
      return refuse(result, run, Standing::by_run);
  }
}

// On one core global EDF is EDF.
System with_edf(System system) {
  system.policy = policies::edf;
  return system;
}

}  // namespace

Result check_globally(const System& system, bool whole, Effort& effort) {
  if (system.cores == 1) return check_partitioned(with_edf(system), whole, effort);
  const Loads loads = with_blocking_in_wcet(system.loads);
  Result result;
  result.response = bounds_of(system, loads);
  result.core.resize(loads.size());
  const bool bounded =
      std::all_of(result.response.begin(), result.response.end(), [](const auto& r) { return r.has_value(); });
  const auto order = compare_utilisation(loads, system.cores);
  if (order && *order > 0) {
    result.verdict = Verdict::not_schedulable;
    result.standing = Standing::proof;
    result.reason = "the tasks need more than all cores";
  } else if (bounded || (system.follows.empty() && passes_gfb(loads, system.cores))) {
    result.verdict = Verdict::schedulable;
    result.standing = Standing::safe;
    result.reason = bounded ? "every task's response is bounded within its deadline (Bertogna, Cirinei)"
                            : "the densities fit the cores (Goossens, Funk, Baruah)";
    return result;
  } else {
    result.reason = "the tests of global_edf are sufficient only, and none of them holds";
  }
  // each bound takes for granted that the other tasks end in time
  result.response.assign(loads.size(), std::nullopt);
  if (result.verdict == Verdict::not_schedulable && !whole) return result;
  for (std::size_t i = 0; i < loads.size(); ++i)
    if (loads[i].jitter + loads[i].wcet > loads[i].deadline && result.verdict != Verdict::not_schedulable) {
      result.verdict = Verdict::not_schedulable;
      result.standing = Standing::proof;
      result.reason = "a task's 'wcet', 'blocking' and 'jitter' together are longer than its deadline";
    }
  walk(system, loads, result, effort);
  return result;
}

}  // namespace jarol::analysis
