// Tasks run in real time on threads of their own; the thread that keeps the time latches and publishes.
#pragma once

#include <vector>

#include "runtime/dispatch/dispatcher.h"
#include "runtime/dispatch/preemptive_threads.h"
#include "runtime/dispatch/releases.h"

namespace jarol {

class OnThreads : public Dispatcher {
 public:
  /// Run and clock outlive it. Throws what PreemptiveThreads throws.
  OnThreads(Run& run, RealClock& clock, std::span<const analysis::TaskThread> threads);

  void end_lets(const Now& now) override;
  void release(const Now& now) override;
  bool runs_on_caller() const override { return false; }

  /// Data-flow tasks that have ended publish, at the instant of their release: nobody has read since. Those that have
  /// not ended although somebody may read now are late. A fault with 'stop' ends the run where it is known, before this
  /// instant.
  void settle(Duration instant) override;
  Duration settled(Duration instant) const override;
  std::optional<HangingTask> first_under_way() const override { return threads_.first_under_way(); }
  std::vector<HangingTask> drain(std::optional<Futex::Time> patience) override;
  std::vector<std::string> refusals() const override { return threads_.refusals(); }

 private:
  void on_bad(std::uint32_t task, Outcome outcome, Duration instant);

  Run& run_;
  RealClock& clock_;
  Releases releases_;
  PreemptiveThreads threads_;
  std::vector<const Activation*> under_way_;  // data-flow tasks that were not yet seen to end
};

}  // namespace jarol
