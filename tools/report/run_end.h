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
  ExecutorRun(Executor& executor, Duration end) : executor_(executor), end_(end) {}
  void cover() override { executor_.cover(end_); }
  bool stopped_by_fault() const override { return executor_.report().stopped; }
  void close(const Ending&, Futex::Time patience) override { executor_.close(patience); }
  std::optional<Holdup> holdup() const override { return executor_.holdup(end_); }
  std::vector<HangingTask> running() const override { return executor_.running(); }
  Finish finish(Futex::Time patience) override { return executor_.finish(patience); }

 private:
  Executor& executor_;
  Duration end_;
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
