// A loaded graph while it runs: its executor, its sinks, its links, and the verdict on it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "distributers/session/linked.h"
#include "distributers/session/planned_graph.h"
#include "distributers/session/run_sinks.h"
#include "distributers/session/verdict.h"
#include "runtime/checkpoint/checkpoint.h"
#include "runtime/execute/executor.h"

namespace jarol {

/// Workers of one run on the virtual clock.
inline constexpr std::size_t max_workers = 64;

struct GraphRunOptions {
  std::vector<RecordSink*> sinks{};  // get all that is published; they outlive the run
  std::size_t workers = 1;
  RealClock* clock = nullptr;                       // none: the virtual clock
  std::span<const analysis::TaskThread> threads{};  // on the real clock: who runs the tasks
  Recorder* log = nullptr;                          // gets what a replay needs
  std::optional<std::span<const Miss>> misses{};    // of a replay
  analysis::Schedule* schedule = nullptr;           // on the virtual clock: what is late, and left out
  std::string times{};                              // what that was made of: a run goes on with the same
  TaskGuard* guard = nullptr;                       // likewise: tasks write nowhere but into their own memory
  std::span<const expect::Condition> measured{};    // beside what the graph expects
  bool truth = false;    // the sinks get where all vehicles truly are, not only what conditions ask for
  bool watched = false;  // the sinks show people what goes on: soon
};

class GraphRun {
 public:
  /// Links are not connected yet. All that the options name outlives it.
  GraphRun(Loaded loaded, const GraphRunOptions& options);
  /// One of many runs of that graph, which outlives it.
  GraphRun(const PlannedGraph& of, RunStart start, const GraphRunOptions& options);

  const Graph& graph() const { return graph_; }
  const std::vector<ExternalSystem*>& channels() const { return channels_; }
  Executor& executor() { return executor_; }
  const Executor& executor() const { return executor_; }
  RunSinks& sinks() { return sinks_; }

  /// Before the first instant. Throws std::runtime_error if there is no way to an external system.
  void connect(NoteSink note) { linked_.emplace(channels_, std::move(note)); }
  /// After the last one.
  void disconnect() { linked_->finish(); }
  /// The same after a run that was attended: waits no longer than for anything else, and notes there what hangs.
  void disconnect(RunEnd& end) { finish_links(*linked_, graph_, end); }
  std::vector<LinkReport> link_reports() const { return linked_->reports(); }

  /// Before it is saved or goes on from what was: what it is made of.
  void set_origin(RunOrigin origin) { origin_ = std::make_shared<const RunOrigin>(std::move(origin)); }
  /// What the run is, on the virtual clock, between two pieces of it; sinks have got all that was published.
  /// Throws CheckpointError.
  Checkpoint checkpoint();
  /// Throws CheckpointError where it is of another origin; parameters of tasks may differ.
  void require_same_origin(const Checkpoint& checkpoint) const;
  /// Goes on as what was saved, of the same origin. Throws CheckpointError where that is damaged, and is of no use
  /// then.
  void restore(const Checkpoint& checkpoint);

  /// After the last instant: sinks have got all, but for those that have failed: throws what these threw.
  void close_sinks() { show_mishaps_and_close(sinks_, graph_, channels_, executor_.report(), executor_.rest()); }

  /// Of a run that was to go on `until` and ended like that.
  RunVerdict judge(Duration until, const RunEnd& end) const;
  /// What was measured of it, likewise; it was to go on until then, whenever its mission ends.
  std::vector<Verdict> measure(Duration until) const;

 private:
  GraphRun(Loaded&& loaded, const Graph& graph, PlanOfRun plan, RunStart start, const GraphRunOptions& options);

  Loaded loaded_;  // empty: others run the graph too
  const Graph& graph_;
  std::vector<ExternalSystem*> channels_;
  RunSinks sinks_;
  Executor executor_;
  std::optional<Linked> linked_;
  std::shared_ptr<const RunOrigin> origin_;
  std::string times_;  // of its schedule; empty: there is none
};

/// What a run of a loaded graph is made of.
RunOrigin origin_of(const Loaded& loaded, const Overrides& overrides, std::uint64_t seed,
                    std::vector<std::string> fed = {});

}  // namespace jarol
