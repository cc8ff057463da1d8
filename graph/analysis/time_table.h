// The static, non-preemptive time table of one core, as `run` walks it: tasks in the order of their releases, those of
// one instant in data-flow order.
#pragma once

#include <optional>
#include <string>

#include "graph/graph.h"

namespace jarol::analysis {

enum class Verdict { schedulable, not_schedulable, unknown };

/// The first job that ends after its deadline when every task takes its WCET.
struct Miss {
  std::size_t task = 0;
  std::int64_t activation = 0;
  Duration release{};
  Duration finish{};
  Duration deadline{};  // absolute
};

struct TableResult {
  Verdict verdict = Verdict::unknown;
  std::string reason;      // one sentence
  double utilisation = 0;  // of the tasks that state a WCET
  std::optional<Miss> miss;
  std::vector<Duration> response;  // per task: the longest found, where the verdict rests on the table
};

/// The order of jobs is fixed, so a start is the later of the job's release and the finish of the one before: shorter
/// execution never makes anything later, and the walk with every WCET decides. It covers the largest offset and two
/// hyperperiods: from then on the backlog repeats (Lindley 1952). More jobs than `most_jobs`: unknown, and said so.
TableResult check_table(const Graph& graph, std::uint64_t most_jobs = 2'000'000);

}  // namespace jarol::analysis
