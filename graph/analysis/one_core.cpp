#include "graph/analysis/one_core.h"

#include <algorithm>

#include "graph/analysis/edf_responses.h"
#include "graph/analysis/explore.h"
#include "graph/analysis/extremes.h"
#include "graph/analysis/fixed_priority.h"
#include "graph/analysis/readiness.h"

namespace jarol::analysis {
namespace {

constexpr std::uint64_t most_simulated = 1'000'000;
constexpr std::uint64_t steps_of_simulated = 10;  // that the simulation takes

bool by_deadline(const Policy& policy) { return policy.urgency == Urgency::deadline; }
Order order_of(const Policy& policy) { return by_deadline(policy) ? Order::by_deadline : Order::by_priority; }

CoreResult undecided(std::string reason, std::vector<std::optional<std::int64_t>> responses = {}) {
  CoreResult result;
  result.reason = std::move(reason);
  result.responses = std::move(responses);
  return result;
}

template <class T>
CoreResult late_one(const T& run, Standing standing, std::vector<Slice> slices) {
  CoreResult result = undecided("a task is late when every task takes its 'wcet'");
  result.verdict = Verdict::not_schedulable;
  result.standing = standing;
  result.late = run.late;
  result.slices = std::move(slices);
  return result;
}

std::vector<std::optional<std::int64_t>> optional(const std::vector<std::int64_t>& responses) {
  return {responses.begin(), responses.end()};
}

CoreResult on_time(std::string reason, const std::vector<std::int64_t>& responses, bool exact) {
  CoreResult result = undecided(std::move(reason), optional(responses));
  result.verdict = Verdict::schedulable;
  result.standing = Standing::proof;
  result.exact = exact;
  return result;
}

// For sporadic tasks: every shift, every jitter.
CoreResult check_any_phasing(std::span<const Load> loads, const Policy& policy, bool responses, Effort& effort) {
  CoreResult result;
  result.standing = Standing::proof;
  if (by_deadline(policy)) {
    const EdfResult edf = check_edf(loads, policy.interrupts, effort);
    if (responses) result.responses = optional(edf_responses(loads, policy.interrupts, effort));
    if (!edf.decided) return undecided("no end of the processor demand was found", result.responses);
    result.verdict = edf.over ? Verdict::not_schedulable : Verdict::schedulable;
    result.demand = edf.over;
    result.reason = edf.over ? "more work is due in an interval than there is time for"
                             : "in no interval more work is due than there is time for (processor demand)";
    return result;
  }
  result.responses = fixed_priority_responses(loads, policy.interrupts, effort);
  bool open = false, late = false;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    if (!result.responses[i]) {
      const auto order = compare_utilisation(loads.first(i + 1), 1);
      (order && *order > 0 ? late : open) = true;
    } else if (*result.responses[i] > loads[i].deadline) {
      late = true;
    }
  }
  result.verdict = late ? Verdict::not_schedulable : open ? Verdict::unknown : Verdict::schedulable;
  result.reason = late   ? "a task's worst response is longer than its deadline"
                  : open ? "no end of a busy period was found"
                         : "every task's worst response is within its deadline (response-time analysis)";
  if (result.verdict == Verdict::unknown) result.standing = Standing::none;
  return result;
}

std::optional<std::int64_t> end_of_repetition(std::span<const Load> loads) {
  std::int64_t largest_offset = 0;
  double activations = 0;
  for (const Load& l : loads) largest_offset = std::max(largest_offset, l.offset);
  const auto lcm = hyperperiod(loads, most_time / 4);
  if (!lcm) return std::nullopt;
  const std::int64_t end = largest_offset + 2 * *lcm;
  for (const Load& l : loads) activations += static_cast<double>(end) / static_cast<double>(l.period);
  return activations <= static_cast<double>(most_simulated) ? std::optional(end) : std::nullopt;
}

bool all_at_once(std::span<const Load> loads) {
  return std::all_of(loads.begin(), loads.end(), [](const Load& l) { return l.offset == 0; });
}

bool has_jitter(std::span<const Load> loads) {
  return std::any_of(loads.begin(), loads.end(), [](const Load& l) { return l.jitter > 0; });
}

bool has_blocking(std::span<const Load> loads) {
  return std::any_of(loads.begin(), loads.end(), [](const Load& l) { return l.blocking > 0; });
}

Loads without_blocking(Loads loads) {
  for (Load& l : loads) l.blocking = 0;
  return loads;
}

// As if readers took no time.
Loads without_readers(const CoreTasks& tasks) {
  std::vector<bool> reads(tasks.loads.size(), false);
  for (const auto& [producer, reader] : tasks.follows) reads[reader] = true;
  Loads loads;
  for (std::size_t i = 0; i < tasks.loads.size(); ++i)
    if (!reads[i]) loads.push_back(tasks.loads[i]);
  return loads;
}

// Is a "no" under EDF one that does not rest on what holds up others that go before?
bool is_sure(std::span<const Load> loads, const Policy& policy, Effort& effort) {
  if (!by_deadline(policy) || !has_blocking(loads)) return true;
  const Loads freely = without_blocking({loads.begin(), loads.end()});
  return check_edf(freely, policy.interrupts, effort).over || is_late_by_own_blocking(loads, policy.interrupts, effort);
}

// The first late activation if all arrive as given.
void add_witness(std::span<const Load> loads, const Policy& policy, CoreResult& result) {
  std::int64_t end = 0;
  for (const Load& l : loads) end = std::max(end, l.offset + 4 * l.period);
  end = std::max(end_of_repetition(loads).value_or(end), result.demand ? result.demand->length : 0);
  Simulation run = simulate(loads, order_of(policy), policy.interrupts, end, most_simulated);
  result.late = run.late;
  if (run.late) result.slices = std::move(run.slices);
}

// Of a walk through all that can happen, to the first late activation or, with `whole`, beyond it.
template <class T>
CoreResult result_of_walk(T walk, bool exact) {
  if (walk.late) {
    CoreResult late = late_one(walk, Standing::proof, std::move(walk.slices));
    late.exact = exact;
    if (exact) late.responses = optional(walk.responses);
    return late;
  }
  if (!walk.whole) return undecided("");
  return on_time("every activation of the whole repetition ends by its deadline", walk.responses, exact);
}

// With offsets that hold, interrupting: without jitter and blocking one run decides, else one from each worst start.
// What holds up one activation at most is not known of those behind it, so that these may never respond so late.
CoreResult walk_preemptive(const CoreTasks& tasks, const Policy& policy, bool whole, Effort& effort) {
  if (effort.spent()) return undecided("");
  const Loads loads = inheriting_loads(tasks);
  if (!end_of_repetition(loads)) return undecided("");
  if (has_jitter(loads) || has_blocking(loads)) {
    Extremes walk = walk_extremes(tasks, order_of(policy), whole, effort);
    // a reader that waits beyond its next arrival holds that up too, which the walk does not know
    const bool each_alone = tasks.follows.empty() || (!walk.late && !has_blocking(loads));
    const bool blocked_alone = !has_blocking(loads) || (!by_deadline(policy) && !walk.late);
    const bool exact = whole && walk.whole && walk.idle && each_alone && blocked_alone;
    return result_of_walk(std::move(walk), exact);
  }
  Simulation run = simulate_repetition(loads, order_of(policy), whole, 4 * most_simulated);
  effort.spend(run.activations * steps_of_simulated);
  const bool exact = whole && run.whole;
  return result_of_walk(std::move(run), exact);
}

// With offsets that hold, not interrupting: shorter execution may change the order and so make others late.
CoreResult walk_nonpreemptive(const CoreTasks& tasks, const Policy& policy, Effort& effort) {
  if (effort.spent()) return undecided("");
  CoreTasks all = tasks;
  all.follows.insert(all.follows.end(), tasks.upward.begin(), tasks.upward.end());
  const Exploration found = explore(all, order_of(policy), effort);
  if (found.late) {
    CoreResult late = late_one(found, Standing::proof, {});
    late.reason = "a task is late in an order that is possible when tasks take up to their 'wcet'";
    if (has_jitter(inheriting_loads(tasks)) || !tasks.upward.empty()) return late;
    if (const auto end = end_of_repetition(tasks.loads)) {
      Simulation run = simulate(tasks.loads, order_of(policy), false, *end, most_simulated);
      if (run.late) return late_one(run, Standing::proof, std::move(run.slices));
    }
    return late;
  }
  if (!found.whole) {
    const auto end = end_of_repetition(tasks.loads);
    if (!end || !tasks.upward.empty()) return undecided("");
    Simulation run = simulate(tasks.loads, order_of(policy), false, *end, most_simulated);
    effort.spend(run.activations * steps_of_simulated);
    if (run.late && !has_jitter(inheriting_loads(tasks))) return late_one(run, Standing::by_run, std::move(run.slices));
    return undecided("");
  }
  return on_time("every activation ends by its deadline in every order that is possible (schedule-abstraction graph)",
                 found.responses, !has_blocking(inheriting_loads(tasks)));
}

// Does what is said of every shift come about, with each task's worst at the same time as that of those before it?
// Under EDF of equal deadlines the others are taken to go first.
bool is_reached(const CoreTasks& tasks, const Policy& policy, bool offsets_hold, Verdict verdict) {
  const Loads loads = inheriting_loads(tasks);
  if (by_deadline(policy) || (!tasks.follows.empty() && (has_jitter(loads) || !policy.interrupts))) return false;
  if (has_blocking(loads) && (!tasks.follows.empty() || !policy.interrupts || verdict != Verdict::schedulable))
    return false;
  return !offsets_hold || (policy.interrupts && all_at_once(loads) && !has_jitter(loads));
}

// Where the offsets are worst the test of every shift decides; what the tasks really take, a short run says.
void take_responses_of_run(std::span<const Load> loads, const Policy& policy, CoreResult& result, Effort& effort) {
  constexpr std::uint64_t most_activations = 50'000;
  const auto end = end_of_repetition(loads);
  if (!end || has_blocking(loads)) return;
  double activations = 0;
  for (const Load& l : loads) activations += static_cast<double>(*end) / static_cast<double>(l.period);
  if (activations > static_cast<double>(most_activations)) return;
  const Simulation run = simulate_repetition(loads, order_of(policy), true, 2 * most_activations);
  effort.spend(run.activations * steps_of_simulated);
  if (!run.whole) return;
  result.responses = optional(run.responses);
  result.exact = true;
}

// Where the test of every shift decides at once: how late anything ends with these offsets, if a short search says.
void take_responses_of_orders(const CoreTasks& tasks, const Policy& policy, CoreResult& result, Effort& effort) {
  constexpr std::uint64_t most_steps = 1'000'000;
  CoreResult found = within(effort, most_steps, [&](Effort& own) { return walk_nonpreemptive(tasks, policy, own); });
  if (found.verdict != Verdict::schedulable || !found.exact) return;
  result.responses = std::move(found.responses);
  result.exact = true;
}

CoreResult decide(const CoreTasks& tasks, const Policy& policy, bool offsets_hold, Detail detail, Effort& effort) {
  const bool responses = detail != Detail::verdict, tight = detail == Detail::tight, whole = detail == Detail::whole;
  const Loads loads = inheriting_loads(tasks);
  CoreResult any = check_any_phasing(loads, policy, responses, effort);
  any.exact = responses && is_reached(tasks, policy, offsets_hold, any.verdict);
  const auto order = compare_utilisation(loads, 1);
  if (order && *order > 0) return any;
  // exact for every shift, but for readers that do not always wait for what they inherited
  const bool readers_hold_up = !policy.interrupts && !tasks.follows.empty();  // those that they wait for: hardly
  const bool inherited = readers_hold_up || (!tasks.follows.empty() && (has_jitter(loads) || has_blocking(loads)));
  const bool worst_at_once = policy.interrupts && all_at_once(loads) && !has_jitter(loads) && !inherited &&
                             !(by_deadline(policy) && has_blocking(loads));
  const bool sure = any.verdict != Verdict::not_schedulable || is_sure(tasks.loads, policy, effort);
  if (sure && !inherited && (!offsets_hold || (worst_at_once && !(tight && any.verdict == Verdict::schedulable)))) {
    if (whole && offsets_hold && !any.exact) take_responses_of_run(loads, policy, any, effort);
    return any;
  }
  // what holds for every shift holds for the one that is given
  if (any.verdict == Verdict::schedulable && !(offsets_hold && responses && (policy.interrupts || tight))) {
    if (whole && offsets_hold) take_responses_of_orders(tasks, policy, any, effort);
    return any;
  }
  CoreResult given = policy.interrupts ? walk_preemptive(tasks, policy, whole && offsets_hold, effort)
                                       : walk_nonpreemptive(tasks, policy, effort);
  // what bounds every shift bounds this one
  if (given.verdict == Verdict::not_schedulable && !given.exact) given.responses = any.responses;
  if (given.verdict == Verdict::not_schedulable || (offsets_hold && given.verdict == Verdict::schedulable))
    return given;
  if (any.verdict == Verdict::schedulable) return any;
  if (!offsets_hold && sure &&
      check_any_phasing(readers_hold_up ? without_readers(tasks) : tasks.loads, policy, false, effort).verdict ==
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

CoreResult check_core(const CoreTasks& tasks, const Policy& policy, bool offsets_hold, Detail detail, Effort& effort) {
  CoreResult result = decide(tasks, policy, offsets_hold, detail, effort);
  // a reader that would go first does not, so that what the tests say of those behind it is too much; exploring knows
  const auto order = compare_utilisation(tasks.loads, 1);
  const bool explored = offsets_hold && !policy.interrupts;
  if (!tasks.upward.empty() && !explored && result.verdict == Verdict::not_schedulable && !(order && *order > 0))
    result = undecided(
        "a task has a higher priority than one that it follows at the same instant; give the producer "
        "the higher one");
  if (detail == Detail::whole && result.verdict == Verdict::not_schedulable && !result.late)
    add_witness(tasks.loads, policy, result);
  result.responses.resize(tasks.loads.size());
  // of readers that go first nothing is said here but what they add
  result.exact = result.exact && tasks.upward.empty();
  return result;
}

}  // namespace jarol::analysis
