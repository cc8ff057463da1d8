// What makes one number of a value over a run, by name.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "graph/model/condition.h"

namespace jarol::expect {

struct NamedReduction {
  std::string_view name;
  Reduction reduction;
};

inline constexpr std::array reductions{NamedReduction{"final", Reduction::final},
                                       NamedReduction{"min", Reduction::min},
                                       NamedReduction{"max", Reduction::max},
                                       NamedReduction{"mean", Reduction::mean},
                                       NamedReduction{"rms", Reduction::rms},
                                       NamedReduction{"rise_time", Reduction::rise_time},
                                       NamedReduction{"overshoot", Reduction::overshoot},
                                       NamedReduction{"settling_time", Reduction::settling_time}};

inline constexpr const char* reduction_names = "final, min, max, mean, rms, rise_time, overshoot, settling_time";

/// Null where no reduction has the name.
constexpr const NamedReduction* find_reduction(std::string_view name) {
  const auto* const found = std::find_if(reductions.begin(), reductions.end(),
                                         [&](const NamedReduction& reduction) { return reduction.name == name; });
  return found == reductions.end() ? nullptr : found;
}

}  // namespace jarol::expect
