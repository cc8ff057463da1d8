// How long activations take, where a run is to have them take what somebody says.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graph/analysis/schedule.h"
#include "graph/model/graph.h"

namespace jarol::analysis {

class ExecutionTimes {
 public:
  /// Every activation takes its WCET.
  static ExecutionTimes wcet(const Graph& graph);
  /// Each takes anything from 1 ns to its WCET, drawn evenly; a function of seed, task and activation.
  static ExecutionTimes random(const Graph& graph, std::uint64_t seed);
  /// As a file says, a mapping of tasks to "80us", "20us..80us", drawn likewise, or a list of these, of which
  /// activations take one after the other, and then the first again. What it does not name takes its WCET.
  static ExecutionTimes read(const Graph& graph, const std::shared_ptr<const Source>& source, std::uint64_t seed,
                             Problems& problems);

  Duration operator()(std::size_t task, std::int64_t activation) const;

 private:
  explicit ExecutionTimes(const Graph& graph, std::uint64_t seed = 0);

  struct Span {
    Duration min{}, max{};
  };
  struct OfTask {
    std::uint64_t seed = 0;
    std::vector<Span> spans;  // in turn
  };
  static bool read_span(const Yaml& yaml, const std::string& subject, Span& span, Problems& problems);

  std::vector<OfTask> tasks_;
};

/// The schedule of the graph's platform with these. Throws InputError where a task has no WCET, or offsets
/// do not hold.
Schedule schedule_of(const Graph& graph, ExecutionTimes times);

}  // namespace jarol::analysis
