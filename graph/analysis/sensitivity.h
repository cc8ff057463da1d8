// How far a system is from the other verdict. Every figure was found by checking again.
#pragma once

#include "graph/analysis/check.h"

namespace jarol::analysis {

struct Sensitivity {
  /// Largest common factor on all WCETs that is still schedulable, to a millionth; nothing if even none is.
  std::optional<double> alpha;
  /// Per task the largest WCET that is schedulable with the others as they are; nothing if none is.
  std::vector<std::optional<Duration>> max_wcet;
  /// Per task a deadline (of a task with a LET: its LET) that is still met while one ns less is not, the others
  /// as they are but for those that it reads at its instant, which end by then, too. Where tasks go by deadline a much
  /// shorter one may be met again.
  std::vector<std::optional<Duration>> min_deadline;
  /// The task whose WCET may grow least, relative to it.
  std::optional<std::size_t> binding;
};

/// With another deadline of a task, and of those that it reads at its instant. The order of a table stays as it was.
System with_deadline(const System& system, std::size_t task, Duration deadline);

/// Leaves out each least deadline that does not hold once the order of a table, which goes by deadlines, follows it.
void confirm_deadlines(const Graph& graph, Sensitivity& sensitivity, Budget& budget);

/// `per_task`: also what costs a search for each task. Nothing if it would take more effort.
std::optional<Sensitivity> sensitivity_of(const System& system, bool per_task, Budget& budget);

/// The largest WCET of one task with which the system is schedulable that is not with the one it has.
struct WcetCut {
  std::size_t task = 0;
  Duration wcet{};
};

/// The smallest cut of its own first; none for more than a hundred tasks, and fewer where it would take more effort.
std::vector<WcetCut> wcet_cuts(const System& system, Budget& budget);

}  // namespace jarol::analysis
