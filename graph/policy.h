// A scheduling policy that graphs may name: what distinguishes it, and its test.
#pragma once

#include <string_view>

namespace jarol {

namespace analysis {
struct Budget;
struct Result;
struct System;
}  // namespace analysis

/// Which of several tasks that could run goes first.
enum class Urgency {
  turn,      // the one that is due first in the order of the graph's one thread
  priority,  // the one with the higher priority: see more_urgent
  deadline,  // the one whose deadline is earlier
};

/// The texts are of the program or of a plugin, which stays loaded.
struct Policy {
  std::string_view name;
  std::string_view how;  // tasks run, as a clause
  Urgency urgency = Urgency::turn;
  bool interrupts = false;  // a task that runs, for a more urgent one
  bool keeps_core = true;   // a task runs on one core always
  bool executed = false;    // by jarol run, on the real clock
  /// `whole`: with witness and responses.
  analysis::Result (*check)(const analysis::System& system, bool whole, analysis::Budget& budget) = nullptr;

  /// Names are unique in a registry.
  bool operator==(const Policy& other) const { return name == other.name; }
};

}  // namespace jarol
