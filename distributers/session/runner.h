// A run of a graph from begin to end, as `jarol run` makes it: clock, guardian, recording, checkpoints, sinks,
// links, and the outcome.
//
//   jarol::Runner runner(std::move(loaded), {.end = 30s, .recording = {.file = "dive.mcap"}});
//   const jarol::RunOutcome outcome = runner.run();
//   CHECK_FALSE(outcome.verdict.is_negative());
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "distributers/session/attendant.h"
#include "distributers/session/errors.h"
#include "distributers/session/execution.h"
#include "distributers/session/graph_run.h"
#include "distributers/session/run_options.h"
#include "distributers/session/run_outcome.h"
#include "distributers/session/threads_run.h"
#include "runtime/record/recording_writer.h"

namespace jarol {

class Runner {
 public:
  /// Called when the guardian stands by, before anything of the run is there; null on the virtual clock, which has
  /// none.
  using OnGuard = std::function<void(const Guard*)>;

  /// What the constructor refuses whatever else there is. Throws WrongInstant where it ends before it begins;
  /// NeedsRealClock; NotExecutable for a number of workers that can't be.
  static void require_runnable(const RunOptions& options, const Loaded& loaded);

  /// Of a graph that was loaded with its systems. Nothing runs yet, and links are not connected. Throws as above;
  /// NotExecutable, where it is for the verdict of check NotSchedulable; SpecError for what is wrong with the execution
  /// times; CheckpointError where it can't go on from what was saved; InputError where an option can't have
  /// its effect: what can't be saved, a recording that would be empty, a graph that threads can't run.
  Runner(
      Loaded loaded, RunOptions options, const OnGuard& on_guard = [](const Guard*) {});
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// The three steps below. Throws what `begin` does.
  RunOutcome run(const Attendant& attendant = {});

  /// Connects links and begins the recording, on the real clock with the run's priority. Throws InputError if
  /// there is no way to an external system, or the recording can't be made.
  void begin();
  /// Covers the instants to the end, on a thread of its own, and lets the links go. What ends it early, a lost system
  /// too, is in what it returns.
  const RunEnd& attend(const Attendant& attendant = {});
  /// Sinks have got all, the recording is closed, and the run is judged. Once; the outcome refers to the runner.
  /// Where the run's end says that something still runs that has to be left behind, the process can only end at once.
  RunOutcome finish();

  // in place of `begin` and `attend`, of exotasks that a program steps by the executor of `exotasks`

  /// As `begin`, but for priorities.
  void connect();
  /// The clock of the calling thread starts, if it is the real one, and the guardian stands by.
  void start();
  /// It was to run until then: what has a `safe` gets that, and the links are let go. Once.
  void stop(Duration until);
  GraphRun& exotasks() { return *exotasks_; }
  const GraphRun& exotasks() const { return *exotasks_; }
  Noted& noted() { return *noted_; }

  const Graph& graph() const { return joined_->graph(); }
  JoinedGraph& joined() { return *joined_; }
  /// When the instants that it covers end.
  Duration end() const { return options_.end; }
  bool has_real_clock() const { return clock_.has_value(); }
  /// Null: none is made.
  const RecordingWriter* recording() const { return recording_.get(); }
  /// The vehicle may be brought to rest at its end.
  std::optional<Duration> longest_rest() const { return longest_rest_; }

 private:
  void make_clock(const Loaded& loaded);
  void make_threads(Loaded loaded);
  void make_exotasks(Loaded loaded);
  void add_stops();
  void save_in_recording(const Checkpoint& checkpoint);

  const RunOptions options_;
  const std::string name_;  // what the user called the graph
  const Duration begun_;
  std::optional<Duration> longest_rest_;
  std::optional<Execution> execution_;
  std::unique_ptr<RecordingWriter> recording_;
  std::optional<RealClock> clock_;
  std::vector<analysis::TaskThread> task_threads_;
  std::optional<Guard> guard_;
  std::optional<Noted> noted_;
  Loaded loaded_;  // of a run on threads
  std::unique_ptr<JoinedGraph> joined_;
  GraphRun* exotasks_ = nullptr;           // which is it, or null
  ThreadsRun* threads_ = nullptr;          // likewise
  std::unique_ptr<ExecutorRun> attended_;  // of exotasks
  SavedRun* saved_ = nullptr;              // which is it on the virtual clock
  Duration until_;                         // to which it was to run
  std::optional<RunEnd> end_;
  double seconds_ = 0;
};

}  // namespace jarol
