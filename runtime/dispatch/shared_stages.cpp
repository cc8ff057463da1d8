#include "runtime/dispatch/shared_stages.h"

#include <algorithm>

#include "runtime/dispatch/one_by_one.h"

namespace jarol {
namespace {

// More than there are processors never pay.
std::size_t useful_workers(std::size_t wanted, Sharing sharing) {
  if (sharing == Sharing::always) return wanted;
  return std::min<std::size_t>(wanted, std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

SharedStages::SharedStages(Run& run, std::size_t workers, Sharing sharing, std::unique_ptr<Dispatcher> alone,
                           analysis::Schedule* schedule)
    : run_(run),
      releases_(run),
      team_(useful_workers(workers, sharing), sharing, run.plan),
      alone_(std::move(alone)),
      schedule_(schedule) {
  bad_.reserve(run.graph.tasks.size());
}

void SharedStages::release(const Now& now) {
  if (!team_.may_share(now.due)) return alone_->release(now);
  releases_.each_stage(now, [&](const Stage& stage) {
    std::uint32_t levels = 0;
    bool deep = false;
    for (const auto& [segment, tick] : stage) {
      deep = deep || segment->publishes_deep;
      levels = std::max(levels, segment->levels.count);
    }
    // a reader's heap shows which of its producers came first
    if (deep && stage.size() > 1) return run_in_order(stage, now);
    for (std::uint32_t level = 0; level < levels; ++level) run_level(stage, level, now);
    report_bad();
  });
}

void SharedStages::run_in_order(const Stage& stage, const Now& now) {
  for (const Releases::Released& released : stage)
    run_one_by_one(run_, released.segment->tasks, *released.tick, now,
                   [&](const Activation& activation, const Tick& tick) {
                     if (schedule_ != nullptr) return AsScheduled(*schedule_)(activation, tick);
                     return BadActivation{activation.run(activation.memory, tick), tick.activation, tick.now};
                   });
}

// The tasks of one level of all segments of the stage: none feeds another.
void SharedStages::run_level(const Stage& stage, std::uint32_t level, const Now& now) {
  team_.clear();
  for (const auto& [segment, tick] : stage) {
    if (level >= segment->levels.count) continue;
    const Indices& tasks = run_.plan.levels[segment->levels.first + level];
    for (const Activation& activation : tasks.of(run_.state.activations)) {
      const auto missed = schedule_ == nullptr ? std::nullopt : find_miss(*schedule_, activation.task, *tick);
      if (missed)
        bad_.push_back({&activation, *missed});
      else
        team_.add(activation, *tick);
    }
  }
  run_.publisher.add_to_digest(team_.run(run_.publisher.with_digest(), now.digest_term));
  for (const StageTeam::Item& item : team_.items()) {
    if (item.outcome != Outcome::good) {
      bad_.push_back({item.activation, {item.outcome, item.tick->activation, item.tick->now}});
    } else if (item.activation->publishes_deep) {
      run_.publisher.publish(item.activation->publish, now);
    } else {
      run_.publisher.record(item.activation->publish, now);
    }
  }
}

// In the order in which one worker would have seen them, which is that of the plan.
void SharedStages::report_bad() {
  std::sort(bad_.begin(), bad_.end(), [](const Bad& a, const Bad& b) { return a.activation < b.activation; });
  for (const Bad& bad : bad_) run_.faults.on_bad(*bad.activation, bad.went);
  bad_.clear();
}

}  // namespace jarol
