// What runs when, for people to look at: every activation takes its WCET and arrives as the offsets say.
#pragma once

#include "graph/analysis/check.h"

namespace jarol::analysis {

struct TimeLine {
  std::int64_t until = 0;  // ns; from 0 on
  std::vector<Slice> slices;
};

/// Under the system's policy, with tasks on the cores of `result`, over a hyperperiod, or as much of it as some 300
/// activations fill.
TimeLine time_line_of(const System& system, const Result& result);

}  // namespace jarol::analysis
