// A graph joined to its world while it runs, whatever executes it: its sinks, its links, and the verdict on it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "distributers/session/linked.h"
#include "distributers/session/run_sinks.h"
#include "distributers/session/verdict.h"
#include "runtime/execute/failsafe.h"
#include "runtime/execute/rest.h"
#include "runtime/state/run_state.h"

namespace jarol {

class JoinedGraph {
 public:
  /// All that is named outlives it; the systems are those of the graph. As of RunSinks.
  JoinedGraph(const Graph& graph, std::vector<ExternalSystem*> systems, std::vector<RecordSink*> sinks,
              std::span<const expect::Condition> measured = {}, Duration hand_on_period = std::chrono::seconds(1))
      : graph_(graph), systems_(std::move(systems)), sinks_(graph, std::move(sinks), measured, hand_on_period) {}
  virtual ~JoinedGraph() = default;
  JoinedGraph(const JoinedGraph&) = delete;
  JoinedGraph& operator=(const JoinedGraph&) = delete;

  const Graph& graph() const { return graph_; }
  const std::vector<ExternalSystem*>& systems() const { return systems_; }
  RunSinks& sinks() { return sinks_; }
  const RunSinks& sinks() const { return sinks_; }

  // of what executes it
  virtual const RunState& state() const = 0;
  virtual const Report& report() const = 0;
  virtual const std::vector<FailsafeReport>& failsafe() const = 0;
  virtual std::optional<RestReport> rest() const = 0;
  /// The instant that is reached. Any thread.
  virtual Duration now() const = 0;

  /// Before the first instant. Throws InputError if there is no way to an external system.
  void connect(NoteSink note) { linked_.emplace(systems_, std::move(note)); }
  /// After the last one.
  void disconnect() { linked_->finish(); }
  /// The same after a run that was attended: waits no longer than for anything else, and notes there what hangs.
  void disconnect(RunEnd& end) { finish_links(*linked_, graph_, end); }
  std::vector<LinkReport> link_reports() const { return linked_->reports(); }

  /// After the last instant: sinks have got all, but for those that have failed: throws what these threw.
  void close_sinks() { show_mishaps_and_close(sinks_, graph_, systems_, report(), rest()); }

  /// Of a run that was to go on `until` and ended like that.
  RunVerdict judge(Duration until, const RunEnd& end) const {
    return judge_run(graph_, report(), systems_, sinks_, rest(), until, end);
  }

 protected:
  /// By the destructor of what owns the systems: links end before these.
  void unlink() { linked_.reset(); }

 private:
  const Graph& graph_;
  std::vector<ExternalSystem*> systems_;
  RunSinks sinks_;
  std::optional<Linked> linked_;
};

}  // namespace jarol
