// Which task runs on which core.
#pragma once

#include <functional>

#include "graph/analysis/system.h"

namespace jarol::analysis {

/// Do these tasks, by index, hold together on one core?
using FitsCore = std::function<bool(const std::vector<std::size_t>& tasks)>;

struct Partition {
  std::vector<std::size_t> core;  // per task
  bool fits = false;
  bool searched = false;  // every assignment was tried
};

/// Given cores are kept. The others, those that follow each other together, go to the first core that they fit, largest
/// utilisation first (Lopez et al. 2004); where that fails and few are left, every assignment is tried.
Partition assign_cores(const System& system, const FitsCore& fits);

}  // namespace jarol::analysis
