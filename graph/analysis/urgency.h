// The order of tasks under fixed priorities.
#pragma once

#include <vector>

#include "graph/analysis/system.h"

namespace jarol::analysis {

/// Stated priorities first, then deadlines (deadline-monotonic); of equal ones who is fed comes after who feeds, then
/// by name.
bool more_urgent(const System& system, std::size_t a, std::size_t b);

/// The tasks most urgent first where the policy goes by priority, else in data-flow order.
std::vector<std::size_t> in_order(const System& system, std::vector<std::size_t> tasks);

}  // namespace jarol::analysis
