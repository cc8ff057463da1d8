#include "graph/analysis/schedule.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "graph/analysis/urgency.h"

namespace jarol::analysis {
namespace {

// Per task, which of those goes first that are equally urgent: see the policies of graph/analysis/README.md.
std::vector<std::size_t> order_of(const System& system) {
  const Policy& policy = system.policy;
  if (policy.urgency == Urgency::turn) return system.turn;
  std::vector<std::size_t> all(system.models.size()), order(system.models.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  if (!policy.keeps_core && system.cores > 1) return all;
  all = in_order(system, std::move(all));
  for (std::size_t i = 0; i < all.size(); ++i) order[all[i]] = i;
  return order;
}

}  // namespace

Schedule::Schedule(System system, std::vector<std::size_t> core, std::vector<bool> skips, ExecutionTime execution)
    : system_(std::move(system)),
      core_(std::move(core)),
      skips_(std::move(skips)),
      execution_(std::move(execution)),
      order_(order_of(system_)) {
  begin();
}

void Schedule::begin() {
  now_ = {};
  releases_ = {};
  ready_.clear();
  tasks_.assign(system_.models.size(), {});
  for (std::size_t i = 0; i < tasks_.size(); ++i) releases_.emplace(system_.models[i].offset, i);
  for (const auto& [producer, reader] : system_.follows) tasks_[reader].producers.push_back(producer);
}

const Fate& Schedule::fate(std::size_t task, std::int64_t activation) {
  OfTask* of = &tasks_[task];
  if (activation < of->first) {
    begin();
    of = &tasks_[task];
  }
  for (;;) {
    while (of->first < activation && !of->fates.empty()) {
      of->fates.pop_front();
      ++of->first;
    }
    if (of->first == activation && !of->fates.empty()) return of->fates.front();
    step();
  }
}

// Up to the next instant at which anything is released or ends.
void Schedule::step() {
  release_due();
  choose();
  Duration next = releases_.top().first;
  for (const std::size_t i : running_) next = std::min(next, now_ + ready_[i].left);
  for (const std::size_t i : running_) ready_[i].left -= next - now_;
  now_ = next;
  for (std::size_t k = running_.size(); k-- > 0;) {
    const Job job = ready_[running_[k]];
    if (job.left > Duration{}) continue;
    ready_.erase(ready_.begin() + static_cast<std::ptrdiff_t>(running_[k]));
    end(job);
  }
}

void Schedule::release_due() {
  while (releases_.top().first == now_) {
    const std::size_t task = releases_.top().second;
    releases_.pop();
    release(task);
    releases_.emplace(now_ + system_.models[task].period, task);
  }
}

void Schedule::release(std::size_t task) {
  OfTask& of = tasks_[task];
  const TaskModel& model = system_.models[task];
  const std::int64_t activation = of.released++;
  if (of.runs) {
    // when it ends is not waited for
    if (!std::exchange(of.known_late, true)) of.fates.push_back({Fate::Kind::late, std::nullopt});
    of.fates.push_back({Fate::Kind::left_out, std::nullopt});
    return;
  }
  if (std::exchange(of.skips_next, false)) {
    of.fates.push_back({Fate::Kind::in_time, std::nullopt});
    return;
  }
  Duration urgency{};
  switch (system_.policy.urgency) {
    case Urgency::turn: urgency = now_; break;
    case Urgency::priority: break;
    case Urgency::deadline: urgency = now_ + model.deadline; break;
  }
  of.runs = activation;
  const Job job{urgency, order_[task], task, activation, now_, execution_(task, activation) + model.overhead, false};
  const auto goes_before = [](const Job& a, const Job& b) {
    return std::tie(a.urgency, a.order) < std::tie(b.urgency, b.order);
  };
  ready_.insert(std::upper_bound(ready_.begin(), ready_.end(), job, goes_before), job);
}

// Has an activation that it follows yet to end?
bool Schedule::waits(const Job& job) const {
  const std::vector<std::size_t>& producers = tasks_[job.task].producers;
  return std::any_of(producers.begin(), producers.end(), [&](std::size_t p) {
    const Duration since = job.release - system_.models[p].offset, period = system_.models[p].period;
    return since >= Duration{} && since % period == Duration{} && tasks_[p].runs == since / period;
  });
}

void Schedule::choose() {
  const Policy& policy = system_.policy;
  running_.clear();
  taken_.assign(static_cast<std::size_t>(system_.cores), false);
  std::size_t free = taken_.size();
  const auto take = [&](std::size_t i) {
    running_.push_back(i);
    ready_[i].started = true;
    --free;
    if (!core_.empty()) taken_[core_[ready_[i].task]] = true;
  };
  const auto is_taken = [&](std::size_t i) { return free == 0 || (!core_.empty() && taken_[core_[ready_[i].task]]); };
  if (!policy.interrupts)
    for (std::size_t i = 0; i < ready_.size(); ++i)
      if (ready_[i].started) take(i);
  for (std::size_t i = 0; i < ready_.size() && free > 0; ++i) {
    if (is_taken(i) || (!policy.interrupts && ready_[i].started)) continue;
    if (!waits(ready_[i])) {
      take(i);
    } else if (policy.urgency == Urgency::turn) {
      // in a table those behind it wait too
      taken_[core_[ready_[i].task]] = true;
    }
  }
  std::sort(running_.begin(), running_.end());
}

void Schedule::end(const Job& job) {
  OfTask& of = tasks_[job.task];
  of.runs.reset();
  // a release that was left out stands for the one to be skipped
  if (std::exchange(of.known_late, false)) return;
  const Duration response = now_ - job.release;
  const bool late = response > system_.models[job.task].deadline;
  of.skips_next = late && skips_[job.task];
  of.fates.push_back({late ? Fate::Kind::late : Fate::Kind::in_time, response});
}

}  // namespace jarol::analysis
