// The scheduling policies there are, each with what distinguishes it and with its test.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "graph/analysis/check.h"

namespace jarol::analysis {

/// Which of several tasks that could run goes first.
enum class Urgency {
  turn,      // the one that is due first in the order of the graph's one thread
  priority,  // the one with the higher priority: see more_urgent
  deadline,  // the one whose deadline is earlier
};

struct PolicyEntry {
  Policy policy = Policy::table;
  std::string_view how;  // tasks run, as a clause
  Urgency urgency = Urgency::turn;
  bool interrupts = false;  // a task that runs, for a more urgent one
  bool keeps_core = true;   // a task runs on one core always
  bool executed = false;    // by jarol run, on the real clock
  /// `whole`: with witness and responses.
  Result (*check)(const System& system, bool whole, Effort& effort) = nullptr;

  std::string name() const;
};

/// One for each name that `policy` may have, in their order.
const std::vector<PolicyEntry>& policies();
const PolicyEntry& entry_of(Policy policy);

}  // namespace jarol::analysis
