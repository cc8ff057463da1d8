// Tasks run one after the other on the thread that calls, each looked at before the next begins.
#pragma once

#include "graph/analysis/schedule.h"
#include "runtime/dispatch/dispatcher.h"
#include "runtime/dispatch/let_ends.h"
#include "runtime/dispatch/releases.h"
#include "runtime/machine/real_clock.h"
#include "runtime/record/log.h"

namespace jarol {

/// Runs the tasks of a row; run_one(activation, tick) says how one went.
template <class RunOne>
void run_one_by_one(Run& run, const Indices& tasks, const Tick& tick, const Now& now, RunOne&& run_one) {
  running_task.tick.store(&tick, std::memory_order_relaxed);
  for (const Activation& activation : tasks.of(run.state.activations)) {
    running_task.next(activation.memory);
    const BadActivation went = run_one(activation, tick);
    if (went.outcome != Outcome::good) {
      run.faults.on_bad(activation, went);
    } else if (!activation.has_let) {
      run.publisher.publish(activation.publish, now);
    }
  }
  running_task.end();
}

/// RunOne: how an activation goes, which may be late or left out.
template <class RunOne>
class OneByOne : public Dispatcher {
 public:
  /// The run outlives it.
  OneByOne(Run& run, RunOne run_one) : run_(run), releases_(run), run_one_(std::move(run_one)) {}

  void end_lets(const Now& now) override {
    jarol::end_lets(run_, now, [&](const Publish& what) { run_.publisher.publish(what, now); });
  }
  void release(const Now& now) override {
    releases_.each_row(
        now, [&](const Indices& tasks, const Tick& tick) { run_one_by_one(run_, tasks, tick, now, run_one_); });
  }

 private:
  Run& run_;
  Releases releases_;
  RunOne run_one_;
};

/// On the real clock: an activation that ends after its deadline has a fault, and so have those whose releases fall
/// into the time that it took.
class InTime {
 public:
  /// Both outlive it.
  InTime(const Graph& graph, RealClock& clock) : graph_(graph), clock_(clock) {}
  BadActivation operator()(const Activation& activation, const Tick& tick);

 private:
  const Graph& graph_;
  RealClock& clock_;
};

/// In a replay: activations come late or are left out as in the run that it repeats.
class AsLogged {
 public:
  AsLogged(const Graph& graph, std::span<const Miss> misses) : missed_(graph.tasks.size(), misses) {}
  BadActivation operator()(const Activation& activation, const Tick& tick);

 private:
  MissedActivations missed_;
};

/// How an activation is missed as a schedule has it; none: it is in time.
std::optional<BadActivation> find_miss(analysis::Schedule& schedule, std::uint32_t task, const Tick& tick);

/// By the schedule of a platform: activations come late or are left out as it has them.
class AsScheduled {
 public:
  /// The schedule outlives it.
  explicit AsScheduled(analysis::Schedule& schedule) : schedule_(schedule) {}
  BadActivation operator()(const Activation& activation, const Tick& tick);

 private:
  analysis::Schedule& schedule_;
};

}  // namespace jarol
