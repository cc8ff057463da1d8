// Can a graph be scheduled on its platform, and if not, why? Pure functions; graph/analysis/README.md says what rests
// on which theorem.
#pragma once

#include <string>

#include "graph/analysis/edf.h"
#include "graph/analysis/simulate.h"
#include "graph/analysis/system.h"

namespace jarol::analysis {

struct Result {
  Verdict verdict = Verdict::unknown;
  Evidence evidence = Evidence::none;
  std::string reason;  // one sentence
  double utilisation = 0;
  // per task, in the order of the graph
  std::vector<std::optional<Duration>> response;  // from the arrival, whatever is late; an upper bound
  std::vector<bool> exact;                        // that bound is reached
  std::vector<std::optional<std::size_t>> core;   // where one runs it always
  // why not
  std::optional<std::size_t> core_at_fault;
  std::optional<DeadlineMiss> late;
  std::vector<Slice> slices;  // on that core, before that
  Duration slices_from{};     // of what ran later none is missing there
  std::optional<Demand> demand;
};

/// "schedulable", "not_schedulable" or "unknown", as programs read it.
const char* word_of(Verdict verdict);

Result check(const System& system);

/// The verdict alone; unknown where it would take more effort.
Verdict verdict_of(const System& system, Budget& budget);

/// Whose deadline is a difference of offsets, where `phasing: any` leaves these open, and what to do; empty: nobody's.
std::string open_deadline(const Graph& graph);

/// The same of a graph; a task without a WCET, or whose deadline is open, leaves it open and is named.
Result check(const Graph& graph);

}  // namespace jarol::analysis
