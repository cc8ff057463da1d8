// A loaded graph while it runs as exotasks: joined to its world, and its executor.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "distributers/session/joined_graph.h"
#include "distributers/session/planned_graph.h"
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

// What a run owns of its graph; before all that refers to it.
class OwnedGraph {
 protected:
  explicit OwnedGraph(Loaded loaded) : loaded_(std::move(loaded)) {}
  Loaded loaded_;  // empty: others run the graph too
};

class GraphRun : private OwnedGraph, public JoinedGraph {
 public:
  /// Links are not connected yet. All that the options name outlives it.
  GraphRun(Loaded loaded, const GraphRunOptions& options);
  /// One of many runs of that graph, which outlives it.
  GraphRun(const PlannedGraph& of, RunStart start, const GraphRunOptions& options);
  ~GraphRun() override { unlink(); }

  Executor& executor() { return executor_; }
  const Executor& executor() const { return executor_; }

  const RunState& state() const override { return executor_.state(); }
  const Report& report() const override { return executor_.report(); }
  const std::vector<FailsafeReport>& failsafe() const override { return executor_.failsafe(); }
  std::optional<RestReport> rest() const override { return executor_.rest(); }
  Duration now() const override { return executor_.now(); }

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

  /// What was measured of it; it was to go on until then, whenever its mission ends.
  std::vector<Verdict> measure(Duration until) const;

 private:
  GraphRun(Loaded&& loaded, const Graph& graph, PlanOfRun plan, RunStart start, const GraphRunOptions& options);

  Executor executor_;
  std::shared_ptr<const RunOrigin> origin_;
  std::string times_;  // of its schedule; empty: there is none
};

/// What a run of a loaded graph is made of.
RunOrigin origin_of(const Loaded& loaded, const Overrides& overrides, std::uint64_t seed,
                    std::vector<std::string> fed = {});

}  // namespace jarol
