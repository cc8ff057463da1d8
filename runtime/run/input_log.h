// What a run logs for its replay: what it has from outside, which activations were late or left out, from when on it is
// brought to rest, and about each second how far it has come.
#pragma once

#include <optional>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/record/log.h"
#include "runtime/record/recorder.h"

namespace jarol {

class InputLog {
 public:
  /// `to` gets log_outputs of the graph; null: nothing is logged.
  InputLog(const Graph& graph, Recorder* to);

  /// What an `in` communicator took.
  void took(std::size_t communicator, const void* value, Duration instant);
  /// An activation that was late, or left out as one before it still ran.
  void late(std::uint32_t task, std::int64_t activation, std::optional<Duration> ended_after, Duration instant);
  void left_out(std::uint32_t task, std::int64_t activation, Duration instant);
  void rest(Duration begun);
  /// At the beginning of an instant: about each second, true asks for a checkpoint.
  bool is_checkpoint_due(Duration instant) const { return to_ != nullptr && instant >= checkpoint_due_; }
  /// All that was due before `settled` is known, and the digest so far. Exact: of nothing that is later.
  void checkpoint(Duration instant, Duration settled, std::uint64_t digest, bool exact);

 private:
  template <class Entry>
  void append(std::uint32_t kind, const Entry& entry, Duration instant);

  const Graph& graph_;
  Recorder* to_;
  std::vector<std::uint32_t> output_of_;  // per communicator: that of the log
  std::uint32_t inputs_ = 0;              // outputs of the log, which those for misses, checkpoints and rest follow
  Duration checkpoint_due_{};
};

}  // namespace jarol
