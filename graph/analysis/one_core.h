// The verdict on the tasks of one core, by the policy's own test.
#pragma once

#include <string>

#include "graph/analysis/edf.h"
#include "graph/analysis/simulate.h"
#include "graph/analysis/system.h"

namespace jarol::analysis {

/// What one core has to do, as far as it can be known there.
struct CoreTasks {
  TaskModels models;  // most urgent first where priorities count, else in data-flow order
  std::vector<std::pair<std::size_t, std::size_t>> follows;  // of these, where the first is more urgent than the second
  std::vector<std::pair<std::size_t, std::size_t>> upward;   // and where the second is
};

struct CoreResult {
  Verdict verdict = Verdict::unknown;
  Evidence evidence = Evidence::none;
  std::string reason;
  std::vector<std::optional<Duration>> responses;  // per model; upper bounds
  std::optional<Demand> demand;                    // why not, under EDF
  std::optional<DeadlineMiss> late;                // why not
  std::vector<Slice> slices;                       // before that
  Duration slices_from{};                          // of what ran later none is missing there
  bool exact = false;                              // each response is reached
};

/// The verdict alone; with responses and witness; or with responses that are as short as offsets and the order of equal
/// deadlines make them.
enum class Detail { verdict, whole, tight };

/// Not for tables. Unknown where it would take more effort.
CoreResult check_core(const CoreTasks& tasks, const Policy& policy, bool offsets_hold, Detail detail, Budget& budget);

/// The same, where walks of all that offsets that hold let happen have a budget of their own: once that is spent, what
/// is said of every shift stands.
CoreResult check_core(const CoreTasks& tasks, const Policy& policy, bool offsets_hold, Detail detail, Budget& budget,
                      Budget& walks);

}  // namespace jarol::analysis
