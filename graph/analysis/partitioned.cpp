// Policies that keep a task on its core: each core by its own test, joined where tasks wait for other cores.
#include <algorithm>

#include "graph/analysis/one_core.h"
#include "graph/analysis/partition.h"
#include "graph/analysis/simulate_global.h"
#include "graph/analysis/systems.h"
#include "graph/analysis/urgency.h"

namespace jarol::analysis {
namespace {

using Follow = std::pair<std::size_t, std::size_t>;  // producer, reader

// Does the policy run the first before the second wherever both are ready?
bool goes_before(const System& s, std::size_t a, std::size_t b) {
  if (s.policy.urgency == Urgency::priority) return more_urgent(s, a, b);
  return std::pair(s.models[a].deadline, s.rank[a]) < std::pair(s.models[b].deadline, s.rank[b]);
}

// What the tests of one core know: its tasks, and who goes before whom there anyway.
CoreTasks tasks_of(const System& system, const std::vector<std::size_t>& tasks, const std::vector<Duration>& waits) {
  CoreTasks core;
  std::vector<std::size_t> index(system.models.size(), tasks.size());
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    TaskModel model = system.models[tasks[k]];
    model.jitter = std::max(model.jitter, waits[tasks[k]]);
    core.models.push_back(model);
    index[tasks[k]] = k;
  }
  for (const auto& [producer, reader] : system.follows)
    if (index[producer] < tasks.size() && index[reader] < tasks.size())
      (goes_before(system, producer, reader) ? core.follows : core.upward).emplace_back(index[producer], index[reader]);
  return core;
}

std::vector<std::vector<std::size_t>> by_core(const System& system, const std::vector<std::size_t>& core) {
  std::vector<std::vector<std::size_t>> tasks(static_cast<std::size_t>(system.cores));
  for (std::size_t i = 0; i < core.size(); ++i) tasks[core[i]].push_back(i);
  for (auto& of_core : tasks) of_core = in_order(system, std::move(of_core));
  return tasks;
}

// Each core with these waits as jitter.
class Cores {
 public:
  /// All outlive it.
  Cores(const System& system, const std::vector<std::size_t>& core)
      : system_(system), core_(core), tasks_(by_core(system, core)) {
    for (const Follow& follow : system.follows)
      if (core[follow.first] != core[follow.second] || !goes_before(system, follow.first, follow.second))
        waiting_.push_back(follow);
  }

  bool waits() const { return !waiting_.empty(); }

  // Without the waits these are no bounds, for whoever shares a core with one that waits.
  void forget_responses_with_waits(Result& result) const {
    for (const Follow& follow : waiting_)
      for (const std::size_t task : tasks_[core_[follow.second]]) result.response[task].reset();
  }

  // Where nobody waits, a core's responses are those that it has by itself.
  void take_responses_without_waits(Result by_itself, Result& result) const {
    forget_responses_with_waits(by_itself);
    for (std::size_t i = 0; i < core_.size(); ++i) {
      if (!by_itself.response[i]) continue;
      result.response[i] = by_itself.response[i];
      result.exact[i] = by_itself.exact[i];
    }
  }

  Result check(const std::vector<Duration>& waits, Detail detail, Budget& budget, Budget& walks) const {
    Result result;
    result.response.resize(system_.models.size());
    result.exact.resize(system_.models.size());
    result.verdict = Verdict::schedulable;
    result.evidence = Evidence::proof;
    if (system_.models.empty()) result.reason = "there is no task to be late";
    for (std::size_t c = 0; c < tasks_.size(); ++c)
      if (!tasks_[c].empty()) add(result, c, waits, detail, budget, walks);
    return result;
  }

  // Readers wait for the responses of those that they follow elsewhere, which depend on such waits: from none on, up to
  // where they stay as they are (holistic analysis: Tindell, Clark 1994). Walks of all rounds together take no more
  // than `max_walked` steps; what holds for every shift holds without any.
  Result check_holistically(std::uint64_t max_walked, Budget& budget) const {
    return within(budget, max_walked, [&](Budget& walks) { return find_waits(budget, walks); });
  }

 private:
  Result find_waits(Budget& budget, Budget& walks) const {
    constexpr int max_rounds = 100;
    std::vector<Duration> waits(system_.models.size());
    for (int round = 0; round < max_rounds; ++round) {
      Result result = check(waits, Detail::tight, budget, walks);
      if (result.verdict != Verdict::schedulable) return result;
      bool changed = false;
      for (const auto& [producer, reader] : waiting_) {
        if (!result.response[producer]) return {};
        changed = changed || *result.response[producer] > waits[reader];
        waits[reader] = std::max(waits[reader], *result.response[producer]);
      }
      if (changed) continue;
      result.evidence = Evidence::safe;
      result.exact.assign(system_.models.size(), false);
      result.reason += ", with the longest waits for those that they follow (holistic analysis)";
      return result;
    }
    return {};
  }

  void add(Result& result, std::size_t c, const std::vector<Duration>& waits, Detail detail, Budget& budget,
           Budget& walks) const {
    const std::vector<std::size_t>& tasks = tasks_[c];
    CoreTasks of_core = tasks_of(system_, tasks, waits);
    if (detail == Detail::tight) {
      // who waits for several there waits for what holds up any of them
      Duration longest{};
      for (const TaskModel& m : of_core.models) longest = std::max(longest, m.blocking);
      for (TaskModel& m : of_core.models) m.blocking = longest;
    }
    CoreResult core = check_core(of_core, system_.policy, system_.offsets_hold, detail, budget, walks);
    for (std::size_t i = 0; i < tasks.size() && detail != Detail::verdict; ++i) {
      result.response[tasks[i]] = core.responses[i];
      result.exact[tasks[i]] = core.exact;
    }
    if (result.reason.empty() || (result.verdict == Verdict::schedulable && core.verdict != Verdict::schedulable))
      result.reason = core.reason;
    if (core.verdict == Verdict::schedulable || result.verdict == Verdict::not_schedulable) return;
    result.verdict = core.verdict;
    result.evidence = core.evidence;
    if (core.verdict != Verdict::not_schedulable) return;
    result.reason = core.reason;
    result.core_at_fault = c;
    result.demand = core.demand;
    if (result.demand) {
      result.demand->releases.assign(system_.models.size(), 0);
      for (std::size_t i = 0; i < tasks.size(); ++i) result.demand->releases[tasks[i]] = core.demand->releases[i];
    }
    if (core.late) {
      core.late->task = tasks[core.late->task];
      result.late = core.late;
    }
    result.slices_from = core.slices_from;
    for (Slice s : core.slices) {
      s.task = tasks[s.task];
      result.slices.push_back(s);
    }
  }

  const System& system_;
  const std::vector<std::size_t>& core_;
  std::vector<std::vector<std::size_t>> tasks_;
  std::vector<Follow> waiting_;
};

// A run that is possible, with every wait: a late activation in it is a "no". Releases as late as they can be, or at
// once.
Result run_with_waits(const System& system, const std::vector<std::size_t>& core, Budget& budget) {
  constexpr std::uint64_t max_activations = 100'000, steps_of_activation = 40;
  Result result;
  result.response.resize(system.models.size());
  result.exact.resize(system.models.size());
  std::vector<std::size_t> all(system.models.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  RunRules rules{system.follows, core, std::vector<std::size_t>(all.size()), {}, false};
  all = in_order(system, std::move(all));
  for (std::size_t i = 0; i < all.size(); ++i) rules.order[all[i]] = i;
  rules.by_order = system.policy.urgency == Urgency::priority;
  rules.preemptive = system.policy.interrupts;
  for (const bool late : {true, false}) {
    TaskModels models = system.models;
    for (TaskModel& m : models) m.jitter = late ? m.jitter : Duration{};
    const GlobalSimulation run =
        simulate_global(models, system.cores, std::min(max_activations, budget.left / steps_of_activation), rules);
    budget.spend(run.activations * steps_of_activation);
    if (!run.late) continue;
    result.verdict = Verdict::not_schedulable;
    result.evidence = Evidence::by_run;
    result.reason = "a task is late when every task takes its 'wcet'";
    result.late = run.late;
    result.core_at_fault = core[run.late->task];
    result.slices_from = run.slices_from;
    for (const Slice& s : run.slices)
      if (core[s.task] == *result.core_at_fault) result.slices.push_back(s);
    return result;
  }
  return result;
}

// With waits a "yes" is safe; a "no" is one without them, as those waited for may take no time.
Result check_assigned(const System& system, const std::vector<std::size_t>& core, Detail detail, Budget& budget) {
  constexpr std::uint64_t max_walked = 5'000'000;
  const Cores cores(system, core);
  Result by_itself = cores.check(std::vector<Duration>(system.models.size()), detail, budget, budget);
  if (!cores.waits()) return by_itself;
  if (by_itself.verdict == Verdict::not_schedulable) {
    if (detail != Detail::verdict) cores.forget_responses_with_waits(by_itself);
    return by_itself;
  }
  // walks are for shorter responses, or for a verdict that nothing else gives
  Result result = cores.check_holistically(detail == Detail::verdict ? 0 : max_walked, budget);
  if (detail == Detail::verdict && result.verdict != Verdict::schedulable)
    result = cores.check_holistically(max_walked, budget);
  if (result.verdict != Verdict::schedulable) {
    result = run_with_waits(system, core, budget);
    if (result.verdict != Verdict::not_schedulable)
      result.reason = "tasks that wait for those that they follow on another core, or of lower priority, may be late";
  }
  if (detail != Detail::verdict) cores.take_responses_without_waits(std::move(by_itself), result);
  return result;
}

}  // namespace

Result check_partitioned(const System& system, bool whole, Budget& budget) {
  constexpr std::uint64_t max_steps_to_assign = 300'000'000;
  const std::vector<Duration> none(system.models.size());
  const auto fits = [&](const std::vector<std::size_t>& tasks, Budget& own) {
    const CoreTasks core = tasks_of(system, in_order(system, tasks), none);
    return check_core(core, system.policy, system.offsets_hold, Detail::verdict, own).verdict;
  };
  const auto holds = [&](const std::vector<std::size_t>& core, Budget& own) {
    return check_assigned(system, core, Detail::verdict, own).verdict;
  };
  const Partition partition =
      within(budget, max_steps_to_assign, [&](Budget& own) { return assign_cores(system, fits, holds, own); });
  Result result = check_assigned(system, partition.core, whole ? Detail::whole : Detail::verdict, budget);
  result.core.assign(partition.core.begin(), partition.core.end());
  qualify_no(system, partition, result.verdict, result.evidence, result.reason);
  return result;
}

}  // namespace jarol::analysis
