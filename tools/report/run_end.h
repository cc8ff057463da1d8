// How a run is attended by a command, and how it ended, in its report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "runtime/execute/attend.h"
#include "runtime/execute/executor.h"

namespace jarol::tools {

/// The executor until that instant.
class ExecutorRun : public AttendedRun {
 public:
  /// On the real clock a graph with `at_end` has its vehicle brought to rest then, and `on_rest` is called with the
  /// instant from which on.
  ExecutorRun(
      Executor& executor, Duration end, std::optional<Duration> longest_rest = {},
      std::function<void(Duration)> on_rest = [](Duration) {})
      : executor_(executor), end_(end), longest_rest_(longest_rest), on_rest_(std::move(on_rest)) {}
  void cover() override {
    executor_.cover(end_);
    const std::optional<Duration> rest = longest_rest_ ? executor_.begin_rest() : std::nullopt;
    if (!rest) return;
    on_rest_(*rest);
    executor_.cover_rest();
  }
  std::optional<Duration> longest_rest() const override { return longest_rest_; }
  void ask_for_rest() override { executor_.ask_for_rest(); }
  bool resting() const override { return executor_.resting(); }
  bool stopped_by_fault() const override { return executor_.report().stopped; }
  void close(const Ending&, Futex::Time patience) override { executor_.close(patience); }
  std::optional<Holdup> holdup() const override { return executor_.holdup(); }
  std::vector<HangingTask> running() const override { return executor_.running(); }
  Finish finish(Futex::Time patience) override { return executor_.finish(patience); }

 private:
  Executor& executor_;
  Duration end_;
  std::optional<Duration> longest_rest_;
  std::function<void(Duration)> on_rest_;
};

/// The thread that attends goes before the one that it attends.
void take_priority_above(std::optional<int> priority);

/// Ctrl-Z has ended the run, all is safe: halts the process as Ctrl-Z does. Nothing if it was something else.
void halt_if_asked(const RunEnd& end);

/// What the first line of the report says of it: " (interrupted)", or nothing.
std::string suffix_of(const RunEnd& end);
/// Lines for stderr: what was lost, and what hangs.
std::string errors_of(const RunEnd& end, Duration now);
nlohmann::ordered_json to_json(const RunEnd& end);
/// Without what can't be written.
int exit_code_of(const RunEnd& end);

}  // namespace jarol::tools
