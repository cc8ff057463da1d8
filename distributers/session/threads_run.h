// A loaded graph while it runs as the Jarol core, on ordinary threads: joined to its world, and attended.
#pragma once

#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "distributers/session/joined_graph.h"
#include "distributers/session/load.h"
#include "distributers/session/note_sink.h"
#include "runtime/jarol/jarol_core.h"
#include "runtime/machine/real_clock.h"

namespace jarol {

class ThreadsRun : public JoinedGraph, public AttendedRun {
 public:
  /// Until that instant. What the machine refuses its threads is noted. `loaded` keeps the graph; all that is named
  /// outlives it.
  ThreadsRun(Loaded& loaded, std::vector<RecordSink*> sinks, Duration end, std::optional<Duration> longest_rest,
             RealTimeOptions real_time, NoteSink note);
  ~ThreadsRun() override { unlink(); }

  const JarolCore& core() const { return core_; }

  const RunState& state() const override { return core_.state(); }
  const Report& report() const override { return core_.report(); }
  const std::vector<FailsafeReport>& failsafe() const override { return core_.failsafe(); }
  std::optional<RestReport> rest() const override { return core_.rest(); }
  Duration now() const override { return core_.now(); }

  void cover() override;
  bool stopped_by_fault() const override { return core_.report().stopped; }
  std::optional<Duration> longest_rest() const override { return longest_rest_; }
  void ask_for_rest() override { core_.ask_for_rest(); }
  bool resting() const override { return core_.resting(); }
  void close(const Ending&, Futex::Time patience) override { core_.close(patience); }
  std::optional<Holdup> holdup() const override { return core_.holdup(); }
  std::vector<HangingTask> running() const override;
  Finish finish(Futex::Time patience) override { return core_.finish(patience); }

 private:
  JarolCore core_;
  Duration end_;
  std::optional<Duration> longest_rest_;
  RealTimeOptions real_time_;
  NoteSink note_;
};

}  // namespace jarol
