// In one file: one decision, test by test in the order in which they are tried.
#include "graph/analysis/one_core.h"

#include <algorithm>

#include "graph/analysis/edf_responses.h"
#include "graph/analysis/explore.h"
#include "graph/analysis/extremes.h"
#include "graph/analysis/fixed_priority.h"
#include "graph/analysis/readiness.h"
#include "graph/analysis/witness.h"

namespace jarol::analysis {
namespace {

constexpr std::uint64_t max_simulated = 1'000'000;
constexpr std::uint64_t steps_of_simulated = 10;  // that the simulation takes

bool by_deadline(const Policy& policy) { return policy.urgency == Urgency::deadline; }
Order order_of(const Policy& policy) { return by_deadline(policy) ? Order::by_deadline : Order::by_priority; }

CoreResult undecided(std::string reason, std::vector<std::optional<Duration>> responses = {}) {
  CoreResult result;
  result.reason = std::move(reason);
  result.responses = std::move(responses);
  return result;
}

template <class T>
CoreResult late_one(const T& run, Evidence evidence, std::vector<Slice> slices, Duration slices_from = {}) {
  CoreResult result = undecided("a task is late when every task takes its 'wcet'");
  result.verdict = Verdict::not_schedulable;
  result.evidence = evidence;
  result.late = run.late;
  result.slices = std::move(slices);
  result.slices_from = slices_from;
  return result;
}

std::vector<std::optional<Duration>> optional(const std::vector<Duration>& responses) {
  return {responses.begin(), responses.end()};
}

CoreResult on_time(std::string reason, const std::vector<Duration>& responses, bool exact) {
  CoreResult result = undecided(std::move(reason), optional(responses));
  result.verdict = Verdict::schedulable;
  result.evidence = Evidence::proof;
  result.exact = exact;
  return result;
}

// For sporadic tasks: every shift, every jitter.
CoreResult check_any_phasing(std::span<const TaskModel> models, const Policy& policy, bool responses, Budget& budget) {
  CoreResult result;
  result.evidence = Evidence::proof;
  if (by_deadline(policy)) {
    const EdfResult edf = check_edf(models, policy.interrupts, budget);
    if (responses) result.responses = optional(edf_responses(models, policy.interrupts, budget));
    if (!edf.decided) return undecided("no end of the processor demand was found", result.responses);
    result.verdict = edf.over ? Verdict::not_schedulable : Verdict::schedulable;
    result.demand = edf.over;
    result.reason = edf.over ? "more work is due in an interval than there is time for"
                             : "in no interval more work is due than there is time for (processor demand)";
    return result;
  }
  result.responses = fixed_priority_responses(models, policy.interrupts, budget);
  bool open = false, late = false;
  for (std::size_t i = 0; i < models.size(); ++i) {
    if (!result.responses[i]) {
      const auto order = compare_utilisation(models.first(i + 1), 1);
      (order && *order > 0 ? late : open) = true;
    } else if (*result.responses[i] > models[i].deadline) {
      late = true;
    }
  }
  result.verdict = late ? Verdict::not_schedulable : open ? Verdict::unknown : Verdict::schedulable;
  result.reason = late   ? "a task's worst response is longer than its deadline"
                  : open ? "no end of a busy period was found"
                         : "every task's worst response is within its deadline (response-time analysis)";
  if (result.verdict == Verdict::unknown) result.evidence = Evidence::none;
  return result;
}

std::optional<Duration> end_of_repetition(std::span<const TaskModel> models) {
  Duration largest_offset{};
  double activations = 0;
  for (const TaskModel& m : models) largest_offset = std::max(largest_offset, m.offset);
  const auto lcm = hyperperiod(models, max_time / 4);
  if (!lcm) return std::nullopt;
  const Duration end = largest_offset + 2 * *lcm;
  for (const TaskModel& m : models)
    activations += static_cast<double>(end.count()) / static_cast<double>(m.period.count());
  return activations <= static_cast<double>(max_simulated) ? std::optional(end) : std::nullopt;
}

bool all_at_once(std::span<const TaskModel> models) {
  return std::all_of(models.begin(), models.end(), [](const TaskModel& m) { return m.offset == Duration{}; });
}

bool has_jitter(std::span<const TaskModel> models) {
  return std::any_of(models.begin(), models.end(), [](const TaskModel& m) { return m.jitter > Duration{}; });
}

bool has_blocking(std::span<const TaskModel> models) {
  return std::any_of(models.begin(), models.end(), [](const TaskModel& m) { return m.blocking > Duration{}; });
}

// Where tasks are not interrupted no piece of one is what holds up another, so that what holds up one task holds up
// those that are less urgent and wait behind it; under EDF the tests know that.
TaskModels loads_of(const CoreTasks& tasks, const Policy& policy) {
  TaskModels models = inheriting_loads(tasks);
  if (policy.interrupts || by_deadline(policy)) return models;
  for (std::size_t i = 1; i < models.size(); ++i)
    models[i].blocking = std::max(models[i].blocking, models[i - 1].blocking);
  return models;
}

TaskModels without_blocking(TaskModels models) {
  for (TaskModel& m : models) m.blocking = {};
  return models;
}

// As if readers took no time.
TaskModels without_readers(const CoreTasks& tasks) {
  std::vector<bool> reads(tasks.models.size(), false);
  for (const auto& [producer, reader] : tasks.follows) reads[reader] = true;
  TaskModels models;
  for (std::size_t i = 0; i < tasks.models.size(); ++i)
    if (!reads[i]) models.push_back(tasks.models[i]);
  return models;
}

// Is a "no" one that does not rest on what holds up others that go before?
bool is_sure(std::span<const TaskModel> models, const Policy& policy, Budget& budget) {
  if (!by_deadline(policy)) {
    const auto shorter = [](const TaskModel& x, const TaskModel& y) { return x.blocking < y.blocking; };
    if (policy.interrupts || std::is_sorted(models.begin(), models.end(), shorter)) return true;
    return check_any_phasing(models, policy, false, budget).verdict == Verdict::not_schedulable;
  }
  if (!has_blocking(models)) return true;
  const TaskModels freely = without_blocking({models.begin(), models.end()});
  return check_edf(freely, policy.interrupts, budget).over ||
         is_late_by_own_blocking(models, policy.interrupts, budget);
}

// Where a late activation is looked for that shows why.
Duration end_of_witness(std::span<const TaskModel> models, const std::optional<Demand>& demand) {
  Duration end{};
  for (const TaskModel& m : models) end = std::max(end, m.offset + 4 * m.period);
  return std::max(end_of_repetition(models).value_or(end), demand ? demand->length : Duration{});
}

// Of a walk through all that can happen, to the first late activation or, with `whole`, beyond it.
template <class T>
CoreResult result_of_walk(T walk, bool exact) {
  if (walk.late) {
    CoreResult late = late_one(walk, Evidence::proof, std::move(walk.slices), walk.slices_from);
    late.exact = exact;
    if (exact) late.responses = optional(walk.responses);
    return late;
  }
  if (!walk.whole) return undecided("");
  return on_time("every activation of the whole repetition ends by its deadline", walk.responses, exact);
}

// With offsets that hold, interrupting: without jitter and blocking one run decides, else one from each worst start.
// What holds up one activation at most is not known of those behind it, so that these may never respond so late.
CoreResult walk_preemptive(const CoreTasks& tasks, const Policy& policy, bool whole, Budget& budget) {
  if (budget.spent()) return undecided("");
  const TaskModels models = inheriting_loads(tasks);
  if (!end_of_repetition(models)) return undecided("");
  if (has_jitter(models) || has_blocking(models)) {
    Extremes walk = walk_extremes(tasks, order_of(policy), whole, budget);
    // a reader that waits beyond its next arrival holds that up too, which the walk does not know
    const bool each_alone = tasks.follows.empty() || (!walk.late && !has_blocking(models));
    const bool blocked_alone = !has_blocking(models) || (!by_deadline(policy) && !walk.late);
    const bool exact = whole && walk.whole && walk.idle && each_alone && blocked_alone;
    return result_of_walk(std::move(walk), exact);
  }
  Simulation run = simulate_repetition(models, order_of(policy), whole, 4 * max_simulated);
  budget.spend(run.activations * steps_of_simulated);
  const bool exact = whole && run.whole;
  return result_of_walk(std::move(run), exact);
}

// With offsets that hold, not interrupting: shorter execution may change the order and so make others late.
CoreResult walk_nonpreemptive(const CoreTasks& tasks, const Policy& policy, Budget& budget) {
  if (budget.spent()) return undecided("");
  CoreTasks all = tasks;
  all.follows.insert(all.follows.end(), tasks.upward.begin(), tasks.upward.end());
  const Exploration found = explore(all, order_of(policy), budget);
  if (found.late) {
    CoreResult late = late_one(found, Evidence::proof, {});
    late.reason = "a task is late in an order that is possible when tasks take up to their 'wcet'";
    if (has_jitter(inheriting_loads(tasks)) || !tasks.upward.empty()) return late;
    if (const auto end = end_of_repetition(tasks.models)) {
      Simulation run = simulate(tasks.models, order_of(policy), false, *end, max_simulated);
      if (run.late) return late_one(run, Evidence::proof, std::move(run.slices), run.slices_from);
    }
    return late;
  }
  if (!found.whole) {
    const auto end = end_of_repetition(tasks.models);
    if (!end || !tasks.upward.empty()) return undecided("");
    Simulation run = simulate(tasks.models, order_of(policy), false, *end, max_simulated);
    budget.spend(run.activations * steps_of_simulated);
    if (run.late && !has_jitter(inheriting_loads(tasks)))
      return late_one(run, Evidence::by_run, std::move(run.slices), run.slices_from);
    return undecided("");
  }
  return on_time("every activation ends by its deadline in every order that is possible (schedule-abstraction graph)",
                 found.responses, !has_blocking(inheriting_loads(tasks)));
}

// Does what is said of every shift come about, with each task's worst at the same time as that of those before it?
// Under EDF of equal deadlines the others are taken to go first.
bool is_reached(const CoreTasks& tasks, const Policy& policy, bool offsets_hold, Verdict verdict) {
  const TaskModels models = inheriting_loads(tasks);
  if (by_deadline(policy) || (!tasks.follows.empty() && (has_jitter(models) || !policy.interrupts))) return false;
  if (has_blocking(models) && (!tasks.follows.empty() || !policy.interrupts || verdict != Verdict::schedulable))
    return false;
  return !offsets_hold || (policy.interrupts && all_at_once(models) && !has_jitter(models));
}

// Where the offsets are worst the test of every shift decides; what the tasks really take, a short run says.
void take_responses_of_run(std::span<const TaskModel> models, const Policy& policy, CoreResult& result,
                           Budget& budget) {
  constexpr std::uint64_t max_activations = 50'000;
  const auto end = end_of_repetition(models);
  if (!end || has_blocking(models)) return;
  double activations = 0;
  for (const TaskModel& m : models)
    activations += static_cast<double>(end->count()) / static_cast<double>(m.period.count());
  if (activations > static_cast<double>(max_activations)) return;
  const Simulation run = simulate_repetition(models, order_of(policy), true, 2 * max_activations);
  budget.spend(run.activations * steps_of_simulated);
  if (!run.whole) return;
  result.responses = optional(run.responses);
  result.exact = true;
}

// Where the test of every shift decides at once: how late anything ends with these offsets, if a short search says.
void take_responses_of_orders(const CoreTasks& tasks, const Policy& policy, CoreResult& result, Budget& budget) {
  constexpr std::uint64_t max_steps = 1'000'000;
  CoreResult found = within(budget, max_steps, [&](Budget& own) { return walk_nonpreemptive(tasks, policy, own); });
  if (found.verdict != Verdict::schedulable || !found.exact) return;
  result.responses = std::move(found.responses);
  result.exact = true;
}

CoreResult decide(const CoreTasks& tasks, const Policy& policy, bool offsets_hold, Detail detail, Budget& budget,
                  Budget& walks) {
  const bool responses = detail != Detail::verdict, tight = detail == Detail::tight, whole = detail == Detail::whole;
  const TaskModels models = loads_of(tasks, policy);
  CoreResult any = check_any_phasing(models, policy, responses, budget);
  any.exact = responses && is_reached(tasks, policy, offsets_hold, any.verdict);
  const auto order = compare_utilisation(models, 1);
  if (order && *order > 0) return any;
  // exact for every shift, but for readers that do not always wait for what they inherited
  const bool readers_hold_up = !policy.interrupts && !tasks.follows.empty();  // those that they wait for: hardly
  const bool inherited = readers_hold_up || (!tasks.follows.empty() && (has_jitter(models) || has_blocking(models)));
  const bool worst_at_once = policy.interrupts && all_at_once(models) && !has_jitter(models) && !inherited &&
                             !(by_deadline(policy) && has_blocking(models));
  const bool sure = any.verdict != Verdict::not_schedulable || is_sure(tasks.models, policy, budget);
  if (sure && !inherited && (!offsets_hold || (worst_at_once && !(tight && any.verdict == Verdict::schedulable)))) {
    if (whole && offsets_hold && !any.exact) take_responses_of_run(models, policy, any, budget);
    return any;
  }
  // what holds for every shift holds for the one that is given
  if (any.verdict == Verdict::schedulable && !(offsets_hold && responses && (policy.interrupts || tight))) {
    if (whole && offsets_hold) take_responses_of_orders(tasks, policy, any, budget);
    return any;
  }
  CoreResult given = policy.interrupts ? walk_preemptive(tasks, policy, whole && offsets_hold, walks)
                                       : walk_nonpreemptive(tasks, policy, walks);
  // what bounds every shift bounds this one, and so do the deadlines that hold
  const bool held_up = !policy.interrupts && has_blocking(models);
  if ((given.verdict == Verdict::not_schedulable || held_up) && !given.exact) given.responses = any.responses;
  if (given.verdict == Verdict::schedulable && held_up) {
    given.responses.resize(models.size());
    for (std::size_t i = 0; i < models.size(); ++i)
      given.responses[i] = std::min(given.responses[i].value_or(models[i].deadline), models[i].deadline);
  }
  if (given.verdict == Verdict::not_schedulable || (offsets_hold && given.verdict == Verdict::schedulable))
    return given;
  if (any.verdict == Verdict::schedulable) return any;
  if (!offsets_hold && sure &&
      check_any_phasing(readers_hold_up ? without_readers(tasks) : tasks.models, policy, false, budget).verdict ==
          Verdict::not_schedulable)
    return any;
  return undecided(
      any.reason + (!sure          ? " if all are held up for the longest 'blocking'; with their own it was not decided"
                    : offsets_hold ? " if offsets could shift; that they hold was not decided"
                                   : " if each reader waits for the worst of what it follows; that it does "
                                     "not was not decided"),
      any.responses);
}

}  // namespace

CoreResult check_core(const CoreTasks& tasks, const Policy& policy, bool offsets_hold, Detail detail, Budget& budget) {
  return check_core(tasks, policy, offsets_hold, detail, budget, budget);
}

CoreResult check_core(const CoreTasks& tasks, const Policy& policy, bool offsets_hold, Detail detail, Budget& budget,
                      Budget& walks) {
  CoreResult result = decide(tasks, policy, offsets_hold, detail, budget, walks);
  // a reader that would go first does not, so that what the tests say of those behind it is too much; exploring knows
  const auto order = compare_utilisation(tasks.models, 1);
  const bool explored = offsets_hold && !policy.interrupts;
  if (!tasks.upward.empty() && !explored && result.verdict == Verdict::not_schedulable && !(order && *order > 0))
    result = undecided(
        "a task has a higher priority than one that it follows at the same instant; give the producer "
        "the higher one");
  if (detail == Detail::whole && result.verdict == Verdict::not_schedulable && !result.late)
    add_witness(tasks, order_of(policy), policy.interrupts, end_of_witness(tasks.models, result.demand), result);
  result.responses.resize(tasks.models.size());
  // of readers that go first nothing is said here but what they add
  result.exact = result.exact && tasks.upward.empty();
  return result;
}

}  // namespace jarol::analysis
