// check --measure and --write: how long a file's tasks take on this machine, and their `wcet` in the file.
#pragma once

#include <optional>
#include <string>

#include "distributers/session/measure.h"
#include "graph/language/load.h"

namespace jarol::tools {

struct MeasureOptions {
  bool measure = false;
  bool write = false;
  bool lower = false;                // write also over a `wcet` that is longer
  std::optional<Duration> duration;  // logical time; none: the mission, else ten seconds
  double margin = 20;                // percent on top of what is written
};

/// Runs the file's graph with these overrides and reports on stderr how much processor time its tasks took. Then, where
/// that is asked for, writes into the file, which is left as it is if it would not load afterwards: per task what 99.9
/// % of its activations stayed below, and the longest disturbance that any task met, but no less than 100 us, with the
/// margin on top. A `wcet` that is stated stays if it is longer than what was met, unless it may be lowered. Throws
/// SpecError, or InputError for what can't be measured or edited; what was measured is shown by then.
/// Returns what was measured.
Measurement measure_file(const std::string& file, const Overrides& overrides, const MeasureOptions& options);

}  // namespace jarol::tools
