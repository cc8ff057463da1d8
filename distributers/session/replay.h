// A run again, from its recording, beside what that says of it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "runtime/execute/executor_run.h"
#include "runtime/record/recorded_run.h"

namespace jarol {

enum class Evidence { same, diverged, unknown };

/// What the replay shows beside the run.
struct Comparison {
  Evidence evidence = Evidence::unknown;
  std::optional<Duration> same_until;      // the newest digest up to which it was
  std::optional<Duration> diverged_until;  // the first one up to which it was not
  bool interrupted = false;
};

/// To the end of what the recording covers, from digest to digest, so that it shows where the two diverge.
class ReplayRun : public ExecutorRun {
 public:
  /// Not `whole`: of some tasks only, whose digest is not that of the run.
  ReplayRun(Executor& executor, const RecordedRun& log, bool whole = true)
      : ExecutorRun(executor, log.covered()), executor_(executor), log_(log), whole_(whole) {}
  void cover() override;
  // it goes on after the fault, to the end of the recording
  bool stopped_by_fault() const override { return false; }

  Comparison comparison;

 private:
  Executor& executor_;
  const RecordedRun& log_;
  const bool whole_;
};

}  // namespace jarol
