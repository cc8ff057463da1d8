// What a run has from outside its graph, and a replay needs: what its `in` communicators took, and which activations
// did not come in time. What a run logs is given to a Recorder.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "graph/model/graph.h"
#include "graph/values/describe.h"
#include "runtime/external_system.h"
#include "runtime/plan/output.h"

namespace jarol {

/// An activation that had a fault on the real clock because it was late or another one was.
struct Miss {
  static constexpr std::int64_t unknown = -1;

  std::int64_t activation = 0;
  std::int64_t ended_after = unknown;  // ns from its release; unknown: it had not ended when it was due
  std::uint32_t task = 0;              // index in the graph
  std::uint32_t left_out = 0;          // 1: as one before it still ran at its release; 0: late

  static constexpr auto fields() {
    return describe(field<&Miss::activation>(), field<&Miss::ended_after>(), field<&Miss::task>(),
                    field<&Miss::left_out>());
  }
};

/// About each second: how far a replay comes with what is logged until then, whatever becomes of the run.
struct RunningDigest {
  std::int64_t settled = 0;  // ns; all that was due at the instants before it is known
  std::uint64_t digest = 0;  // of the run so far
  std::uint64_t exact = 0;   // 1: that is of the instants before `settled`; 0: some that are later are in it

  static constexpr auto fields() {
    return describe(field<&RunningDigest::settled>(), field<&RunningDigest::digest>(), field<&RunningDigest::exact>());
  }
};

/// Once at most: the vehicle is brought to rest, as at_end states.
struct RestBegin {
  std::int64_t begun = 0;  // ns; from this instant on

  static constexpr auto fields() { return describe(field<&RestBegin::begun>()); }
};

/// The communicators whose values come from outside, in the order of the graph.
std::vector<std::size_t> logged_inputs(const Graph& graph);

/// What the Recorder of a log records: what each of `logged_inputs` took, then a Miss, then a RunningDigest, then a
/// RestBegin.
std::vector<Output> log_outputs(const Graph& graph);

/// The misses of a run, asked for in the order in which each task's activations come.
class MissedActivations {
 public:
  MissedActivations(std::size_t tasks, std::span<const Miss> misses);

  /// Null: the activation came in time. Not before one that was asked for earlier.
  const Miss* find(std::size_t task, std::int64_t activation);

 private:
  std::vector<std::vector<Miss>> misses_;  // per task, in order of activations
  std::vector<std::size_t> next_;          // per task
};

/// What the `in` communicators of a run took, in its order.
class TakenValues {
 public:
  virtual ~TakenValues() = default;
  /// False: the communicator took nothing at that instant. Throws std::runtime_error if the values are of another
  /// graph.
  virtual bool take(Duration instant, std::size_t communicator, void* value) = 0;
};

/// Gives the `in` communicators of a distributer what they took.
class ReplayedSystem : public ExternalSystem {
 public:
  /// The values outlive it.
  ReplayedSystem(const Graph& graph, std::size_t distributer, TakenValues& values);

  void reach(Duration instant) override { now_ = instant; }
  bool take(std::size_t channel, void* value) override { return values_.take(now_, communicators_[channel], value); }
  void hand_over(std::size_t, const void*) override {}

 private:
  TakenValues& values_;
  std::vector<std::size_t> communicators_;  // per channel
  Duration now_{};
};

/// One per distributer of the graph. `values` outlive them.
std::vector<std::unique_ptr<ExternalSystem>> replayed_systems(const Graph& graph, TakenValues& values);

}  // namespace jarol
