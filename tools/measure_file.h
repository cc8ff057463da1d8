// check --measure and --write: how long a file's tasks take on this machine, and their `wcet` in the file.
#pragma once

#include <optional>
#include <string>

#include "graph/spec/load.h"

namespace jarol::tools {

struct MeasureOptions {
  bool measure = false;
  bool write = false;
  bool lower = false;                // write also over a `wcet` that is longer
  std::optional<Duration> duration;  // logical time; none: the mission, else ten seconds
  double margin = 20;                // percent on top of what is written
};

/// Runs the file's graph with these overrides and tells on stderr how much processor time its tasks took. Then, where
/// that is asked for, writes the longest times with the margin into the file, which is left as it is if it would not
/// load afterwards. A `wcet` that is stated and longer stays, unless it may be lowered. Throws SpecError, or
/// std::invalid_argument for what can't be measured or edited; what was measured is told by then.
void measure_file(const std::string& file, const Overrides& overrides, const MeasureOptions& options);

}  // namespace jarol::tools
