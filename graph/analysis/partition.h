// Which task runs on which core.
#pragma once

#include <functional>

#include "graph/analysis/system.h"

namespace jarol::analysis {

/// The verdict on these tasks, by index, together on one core, whatever they follow elsewhere. More tasks never hold
/// where fewer do not: any may take no time.
using FitsCore = std::function<Verdict(const std::vector<std::size_t>& tasks, Budget& budget)>;

/// The verdict on all of them, with the core of each.
using Holds = std::function<Verdict(const std::vector<std::size_t>& core, Budget& budget)>;

struct Partition {
  std::vector<std::size_t> core;  // per task
  bool holds = false;             // was seen to
  bool refuted = false;           // every assignment was tried, and none can hold
};

/// Given cores are kept. The others are tried, largest utilisation first, on the first core that they fit (Lopez et al.
/// 2004): those that follow each other together, then each alone, then each on the least used core. Where none of these
/// holds, every assignment is tried, or a good many of them.
Partition assign_cores(const System& system, const FitsCore& fits, const Holds& holds, Budget& budget);

/// A "no" of one assignment is a "no" only where others can't hold either; else it is unknown, and said so.
void qualify_no(const System& system, const Partition& partition, Verdict& verdict, Evidence& evidence,
                std::string& reason);

}  // namespace jarol::analysis
