// How long activations of a small set may take where they may be late: each runs to its end, and those behind it wait.
// Every execution time from 0 to the WCET, every release delay, and every shift where shifts are possible is tried;
// shares no code with graph/analysis, nor a search with truth.h, whose ends with what is late.
#pragma once

#include "tests/graph/analysis/truth.h"

namespace jarol::truth {

/// The longest response of each task, from the arrival; nothing where backlog grows, or states are more than
/// `max_states`. A set without `blocking`, each task on a core of its own policy: not global EDF.
std::optional<std::vector<int>> late_truth_of(const Set& set, const std::vector<std::size_t>& core,
                                              const Places& places, std::size_t max_states);

}  // namespace jarol::truth
