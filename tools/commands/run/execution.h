// Execution times that a run on the virtual clock is given: run --execution.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "graph/analysis/schedule.h"
#include "graph/model/graph.h"

namespace jarol::tools {

class Command;

void add_execution_option(Command& command, std::string& execution);
/// It says nothing on the real clock.
void require_execution_effect(const Command& command, bool virtual_clock);

class Execution {
 public:
  /// "wcet", "random" or a file; empty: nothing is ever late. Throws SpecError with all that is wrong with the file,
  /// std::invalid_argument where the graph has no such schedule.
  Execution(const std::string& execution, const Graph& graph, std::uint64_t seed);

  /// Null: there is none.
  analysis::Schedule* schedule() { return schedule_ ? &*schedule_ : nullptr; }
  /// What it was made of: "wcet", "random", or "FILE" and its text.
  const std::string& times() const { return times_; }

 private:
  std::optional<analysis::Schedule> schedule_;
  std::string times_;
};

/// As a recording names it.
std::string recorded_execution(const std::string& execution);

/// A line of the report: "  execution   random, by table on one core"; empty: none was asked for.
std::string execution_text(const std::string& execution, const Graph& graph);

}  // namespace jarol::tools
