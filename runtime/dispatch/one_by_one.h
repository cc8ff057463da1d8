// Tasks run one after the other on the thread that calls, where an activation may be late or left out: who derives from
// this says how one runs.
#pragma once

#include "runtime/dispatch/dispatcher.h"
#include "runtime/dispatch/releases.h"
#include "runtime/machine/real_clock.h"
#include "runtime/record/log.h"

namespace jarol {

class OneByOne : public Dispatcher {
 public:
  explicit OneByOne(Run& run) : run_(run), releases_(run) {}

  void end_lets(const Now& now) override;
  void release(const Now& now) override;

 protected:
  /// How the activation went; what is not good has its outcome there.
  virtual BadActivation run_one(const Activation& activation, const Tick& tick) = 0;

 private:
  Run& run_;
  Releases releases_;
};

/// On the real clock: an activation that ends after its deadline has a fault, and so have those whose releases fall
/// into the time that it took.
class InTime : public OneByOne {
 public:
  /// Both outlive it.
  InTime(Run& run, RealClock& clock) : OneByOne(run), graph_(run.graph), clock_(clock) {}

 private:
  BadActivation run_one(const Activation& activation, const Tick& tick) override;

  const Graph& graph_;
  RealClock& clock_;
};

/// In a replay: activations come late or are left out as in the run that it repeats.
class AsLogged : public OneByOne {
 public:
  /// The run outlives it.
  AsLogged(Run& run, std::span<const Miss> misses) : OneByOne(run), missed_(run.graph.tasks.size(), misses) {}

 private:
  BadActivation run_one(const Activation& activation, const Tick& tick) override;

  MissedActivations missed_;
};

}  // namespace jarol
