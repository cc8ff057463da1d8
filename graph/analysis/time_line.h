// What runs when, for people to look at: every activation takes its WCET and arrives as the offsets say.
#pragma once

#include <optional>

#include "graph/analysis/check.h"

namespace jarol::analysis {

struct TimeLine {
  Duration until{};               // from 0 on
  std::optional<Duration> round;  // after which all repeats; none: not all of it is known
  std::vector<Slice> slices;
};

struct TimeLineLength {
  // Two hyperperiods after the last offset, where there are offsets: what is left over from the first may make the
  // second another one; all that follow are as the second (Leung and Merrill 1980).
  bool until_it_repeats = false;
  double max_activations = 300;
};

/// Under the system's policy, with tasks on the cores of `result`, as long as that says, or as much of it as so many
/// activations fill.
TimeLine time_line_of(const System& system, const Result& result, const TimeLineLength& length = {});

}  // namespace jarol::analysis
