#include "graph/analysis/one_core.h"

#include <algorithm>

#include "graph/analysis/fixed_priority.h"

namespace jarol::analysis {
namespace {

constexpr std::int64_t most_time = std::int64_t{1} << 60;
constexpr std::uint64_t most_activations = 1'000'000;
constexpr std::uint64_t steps_of_activation = 10;  // that the simulation takes

bool by_deadline(Policy policy) { return policy == Policy::edf || policy == Policy::edf_nonpreemptive; }
bool is_preemptive(Policy policy) { return policy == Policy::edf || policy == Policy::fixed_priority; }

// For sporadic tasks: every shift, every jitter.
CoreResult check_any_phasing(std::span<const Load> loads, Policy policy, bool responses, Effort& effort) {
  CoreResult result;
  result.standing = Standing::proof;
  if (by_deadline(policy)) {
    const EdfResult edf = check_edf(loads, is_preemptive(policy), effort);
    if (!edf.decided)
      return {Verdict::unknown, Standing::none, "no end of the processor demand was found", {}, {}, {}, {}};
    result.verdict = edf.over ? Verdict::not_schedulable : Verdict::schedulable;
    result.demand = edf.over;
    result.reason = edf.over ? "more work is due in an interval than there is time for"
                             : "in no interval more work is due than there is time for (processor demand)";
    if (responses && !edf.over && policy == Policy::edf)
      for (const std::int64_t r : edf_responses(loads)) result.responses.emplace_back(r);
    result.responses.resize(loads.size());
    return result;
  }
  result.responses = fixed_priority_responses(loads, is_preemptive(policy), effort);
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
  return activations <= static_cast<double>(most_activations) ? std::optional(end) : std::nullopt;
}

bool all_at_once(std::span<const Load> loads) {
  return std::all_of(loads.begin(), loads.end(), [](const Load& l) { return l.offset == 0; });
}

bool only_offsets(std::span<const Load> loads) {
  return std::all_of(loads.begin(), loads.end(), [](const Load& l) { return l.jitter == 0 && l.blocking == 0; });
}

// The first late activation if all arrive as given.
void add_witness(std::span<const Load> loads, Policy policy, CoreResult& result) {
  std::int64_t end = 0;
  for (const Load& l : loads) end = std::max(end, l.offset + 4 * l.period);
  end = std::max(end_of_repetition(loads).value_or(end), result.demand ? result.demand->length : 0);
  Simulation run = simulate(loads, by_deadline(policy) ? Order::by_deadline : Order::by_priority, is_preemptive(policy),
                            end, most_activations);
  result.late = run.late;
  if (run.late) result.slices = std::move(run.slices);
}

CoreResult decide(std::span<const Load> loads, Policy policy, bool offsets_hold, bool responses, Effort& effort) {
  CoreResult any = check_any_phasing(loads, policy, responses, effort);
  if (!offsets_hold || (is_preemptive(policy) && all_at_once(loads))) return any;
  // the offsets are as given: what holds for every shift holds for this one
  if (any.verdict == Verdict::schedulable && !(responses && is_preemptive(policy))) return any;
  const auto order = compare_utilisation(loads, 1);
  if (order && *order > 0) return any;
  const auto end = only_offsets(loads) && !effort.spent() ? end_of_repetition(loads) : std::nullopt;
  const std::string undecided = any.reason + " if offsets could shift; that they hold was not decided";
  if (!end || !order) {
    if (any.verdict != Verdict::schedulable)
      any = {Verdict::unknown, Standing::none, undecided, any.responses, {}, {}, {}};
    return any;
  }
  const Simulation run = simulate(loads, by_deadline(policy) ? Order::by_deadline : Order::by_priority,
                                  is_preemptive(policy), *end, 4 * most_activations);
  effort.spend(run.activations * steps_of_activation);
  if (run.late) {
    CoreResult late{Verdict::not_schedulable,
                    Standing::proof,
                    "a task is late when every task takes its 'wcet'",
                    std::vector<std::optional<std::int64_t>>(loads.size()),
                    {},
                    run.late,
                    run.slices};
    return late;
  }
  if (!is_preemptive(policy)) {
    // shorter execution may change the order, and so make others late
    if (any.verdict == Verdict::schedulable) return any;
    return {Verdict::unknown,
            Standing::simulated,
            "none is late when every task takes its 'wcet', but shorter execution may make one late",
            {},
            {},
            {},
            {}};
  }
  any.verdict = Verdict::schedulable;
  any.standing = Standing::proof;
  any.demand.reset();
  any.reason = "every activation of the whole repetition ends by its deadline";
  any.responses.clear();
  for (const std::int64_t r : run.responses) any.responses.emplace_back(r);
  return any;
}

}  // namespace

Verdict verdict_of_core(std::span<const Load> loads, Policy policy, bool offsets_hold, Effort& effort) {
  return decide(loads, policy, offsets_hold, false, effort).verdict;
}

CoreResult check_core(std::span<const Load> loads, Policy policy, bool offsets_hold) {
  Effort effort;
  CoreResult result = decide(loads, policy, offsets_hold, true, effort);
  if (result.verdict == Verdict::not_schedulable && !result.late) add_witness(loads, policy, result);
  result.responses.resize(loads.size());
  return result;
}

}  // namespace jarol::analysis
