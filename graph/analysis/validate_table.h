// Looks at a finished time table as a stranger would: is it one, and does it hold?
#pragma once

#include <string>

#include "graph/analysis/simulate.h"
#include "graph/analysis/system.h"

namespace jarol::analysis {

/// `slices` are all activations that arrive before `end`, in any order. Returns what is wrong, or nothing: every
/// activation stands there once and whole, on its core alone, within its window, after those that it follows; and at
/// the end each core has as much left to do as `repetition` before, so that the table goes on as it is.
std::string fault_of_table(const System& system, const std::vector<std::size_t>& core, std::vector<Slice> slices,
                           Duration end, Duration repetition);

}  // namespace jarol::analysis
