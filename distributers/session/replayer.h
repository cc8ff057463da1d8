// A run again, from its recording, from begin to end: `jarol replay` as a program has it.
//
//   jarol::RecordedRun log("dive.mcap");
//   jarol::Replayer replayer(log, jarol::built_in());
//   CHECK(replayer.run().comparison.evidence == jarol::Evidence::same);
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/attendant.h"
#include "distributers/session/graph_run.h"
#include "distributers/session/only_tasks.h"
#include "distributers/session/replay.h"
#include "distributers/session/replay_start.h"
#include "distributers/session/run_outcome.h"
#include "distributers/session/run_words.h"
#include "runtime/record/recorded_run.h"
#include "runtime/record/replayed_values.h"

namespace jarol {

struct ReplayOptions {
  std::string file{};               // another graph than that of the run, or the same where it names plugins; empty: as
                                    // the run has read it
  Overrides overrides{};            // beside those of the run
  std::vector<std::string> only{};  // only these tasks, with what the recording has of what they read; empty: all
  std::optional<Duration> from{};   // begins at the newest checkpoint that is not later; none: where the recording does
  NoteSink note = no_notes;         // gets what is worth knowing and no error, as of load_graph
  RunWords words{};                 // of messages
};

/// What a replay shows beside the run.
struct ReplayOutcome {
  RunOutcome run;
  Comparison comparison;
  const Differences& differences;
};

class Replayer {
 public:
  /// Loads the graph. The recording outlives it. Throws SpecError for what is wrong with the graph; LogError;
  /// InputError where the recording can't be replayed like that.
  Replayer(RecordedRun& log, const distributers::Registries& known, ReplayOptions options = {});
  Replayer(const Replayer&) = delete;
  Replayer& operator=(const Replayer&) = delete;

  /// The three steps below.
  ReplayOutcome run(const Attendant& attendant = {});

  /// Those get all that is published, and with `truth` where vehicles truly were, and outlive it. Throws
  /// InputError where there is nothing to compare with, or the checkpoint is damaged.
  void begin(std::vector<RecordSink*> sinks = {}, bool truth = false);
  /// Covers what the recording covers. Throws what a task's world throws.
  const RunEnd& attend(const Attendant& attendant = {});
  /// Sinks have got all, and the run is compared and judged. Once; the outcome refers to the replayer. Throws
  /// LogError where values of the recording were left over.
  ReplayOutcome finish();

  /// Before `begin`: what is replayed.
  const Loaded& loaded() const { return loaded_; }
  /// Those of the run and those given.
  const Overrides& overrides() const { return overrides_; }
  Duration now() const { return run_->now(); }
  Duration begun() const { return begun_; }
  std::size_t misses() const { return misses_.size(); }
  /// What is expected is about whole runs.
  bool judges() const { return judges_; }
  /// Its graph is another text than that of the run.
  bool is_other_text() const { return is_other_text_; }

 private:
  void take_only();
  void compare();
  RunVerdict judge(Duration reached);

  RecordedRun& log_;
  const ReplayOptions options_;
  const Duration begun_;
  const Overrides overrides_;
  const RecordedWorld world_;
  Loaded whole_, loaded_;
  std::vector<Miss> misses_;
  std::optional<OnlyTasks> only_;
  bool judges_ = true;
  bool is_other_text_ = false;
  std::optional<Noted> noted_;
  std::optional<ReplayedValues> values_;
  std::optional<GraphRun> run_;
  std::optional<ReplayRun> attended_;
  std::optional<RunEnd> end_;
  double seconds_ = 0;
};

}  // namespace jarol
