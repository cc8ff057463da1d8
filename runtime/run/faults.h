// What becomes of activations that were not good: their faults are reported, and the task's state is put back if the
// graph says so.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/run/input_log.h"
#include "runtime/run/publisher.h"
#include "runtime/run/report.h"
#include "runtime/state/run_state.h"

namespace jarol {

/// An activation that was not good.
struct BadActivation {
  Outcome outcome = Outcome::good;
  std::int64_t activation = 0;
  Duration instant{};                     // of its release
  std::optional<Duration> ended_after{};  // of one that is late: from its release; none: it had not when it was due
  bool ran = true;                        // false: in a replay, where what is late need not run
};

class Faults {
 public:
  Faults(RunState& state, Report& report, Publisher& publisher, InputLog& log);

  /// On the thread that ran it, right away. A LET task's fault shows at the end of its LET, when its outputs would
  /// have: see `end_let`.
  [[gnu::cold]] void on_bad(const Activation& activation, const BadActivation& bad);

  /// The end of a LET, where some that are under way have faults or may have: true, its outputs are published.
  bool end_let(const LetEnd& let_end, Duration instant);

  /// If the graph says that the task goes on after a fault: its state and outputs are as before the activation, which
  /// need not be put back if it has not run.
  void restore(const Activation& activation, bool ran = true);

  /// A fault of a task with these outputs, at the instant at which it would have published. What it threw is in its
  /// status. With `stop` it ends the run.
  void add(std::uint32_t task, const BadActivation& bad, const void* out);

 private:
  bool has_late_fault(const LetEnd& let_end, Duration instant);
  std::string cause_of(std::uint32_t task, const BadActivation& bad, const void* out) const;
  void add_noted(std::uint32_t task, Duration instant);
  void add(std::uint32_t task, std::int64_t activation, Duration instant, std::string_view cause);
  bool reaches_limit(std::uint32_t task, std::int64_t activation);

  const Graph& graph_;
  RunState& state_;
  Report& report_;
  Publisher& publisher_;
  InputLog& log_;
};

}  // namespace jarol
