// Execution times that a run on the virtual clock is given.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "graph/analysis/schedule.h"
#include "graph/model/graph.h"

namespace jarol {

class Execution {
 public:
  /// "wcet", "random" or a file; empty: nothing is ever late. Throws SpecError with all that is wrong with the file,
  /// InputError where the graph has no such schedule; `option`: what messages call it.
  Execution(const std::string& execution, const Graph& graph, std::uint64_t seed,
            const std::string& option = ".execution");

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

}  // namespace jarol
