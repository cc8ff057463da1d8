// A run again, from its log, beside what the log says of it.
#pragma once

#include <optional>

#include "runtime/execute/executor_run.h"
#include "runtime/record/log_reader.h"

namespace jarol {

enum class Standing { same, diverged, unknown };

/// What the replay shows beside the run.
struct Comparison {
  Standing standing = Standing::unknown;
  std::optional<Duration> same_until;      // the newest checkpoint up to which it was
  std::optional<Duration> diverged_until;  // the first one up to which it was not
  bool interrupted = false;
};

/// To the end of what the log covers, from checkpoint to checkpoint, so that it shows where the two diverge.
class ReplayRun : public ExecutorRun {
 public:
  ReplayRun(Executor& executor, const LogReader& log)
      : ExecutorRun(executor, log.covered()), executor_(executor), log_(log) {}
  void cover() override;
  // it goes on after the fault, to the end of the log
  bool stopped_by_fault() const override { return false; }

  Comparison comparison;

 private:
  Executor& executor_;
  const LogReader& log_;
};

}  // namespace jarol
