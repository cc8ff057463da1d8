// Which task runs on which core.
#pragma once

#include <functional>

#include "graph/analysis/system.h"

namespace jarol::analysis {

/// The verdict on these tasks, by index, together on one core.
using FitsCore = std::function<Verdict(const std::vector<std::size_t>& tasks)>;

struct Partition {
  std::vector<std::size_t> core;  // per task
  bool fits = false;
  bool refuted = false;  // every assignment was tried, and none can hold
};

/// Given cores are kept. The others, those that follow each other together, go to the first core that they fit, largest
/// utilisation first (Lopez et al. 2004); where that fails and few are left, every assignment is tried, or a good many
/// of them.
Partition assign_cores(const System& system, const FitsCore& fits);

}  // namespace jarol::analysis
