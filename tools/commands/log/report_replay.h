// What the replay of a recording adds to its report: whether it comes out the same, what the graph expects, and how
// long its tasks take.
#pragma once

#include "distributers/session/load.h"
#include "distributers/session/measure.h"
#include "distributers/session/replay.h"
#include "distributers/session/verdict.h"

namespace jarol::tools {

struct ReportReplay {
  Evidence evidence = Evidence::unknown;
  std::uint64_t compared = 0;  // values
  RunVerdict verdict{};
  std::vector<MeasuredTask> measured{};  // of a second replay; empty: it had no activation, or the clock is too coarse
};

/// Runs all that the recording covers, twice, without its vehicles; `other_graph`: by another text than the run.
/// Throws LogError where its tasks and outputs are other ones.
ReportReplay replay_for_report(RecordedRun& run, Loaded loaded, bool other_graph);

}  // namespace jarol::tools
