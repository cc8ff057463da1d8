#include "distributers/session/execution.h"

#include "graph/analysis/execution_times.h"
#include "graph/language/source_set.h"
#include "graph/text/errors.h"

namespace jarol {
namespace {

using analysis::ExecutionTimes;

ExecutionTimes read_times(const Graph& graph, const std::shared_ptr<const Source>& source, std::uint64_t seed) {
  Problems problems;
  ExecutionTimes times = ExecutionTimes::read(graph, source, seed, problems);
  problems.throw_if_any();
  return times;
}

}  // namespace

Execution::Execution(const std::string& execution, const Graph& graph, std::uint64_t seed, const std::string& option) {
  if (execution.empty()) return;
  times_ = execution;
  const auto make = [&]() -> ExecutionTimes {
    if (execution == "wcet") return ExecutionTimes::wcet(graph);
    if (execution == "random") return ExecutionTimes::random(graph, seed);
    const std::shared_ptr<const Source> source = read_source(execution);
    times_ = "FILE\n" + source->text;
    return read_times(graph, source, seed);
  };
  ExecutionTimes times = make();
  try {
    schedule_.emplace(analysis::schedule_of(graph, std::move(times)));
  } catch (const InputError& wrong) { throw InputError(option + ": " + wrong.what()); }
}

std::string recorded_execution(const std::string& execution) {
  const bool is_file = !execution.empty() && execution != "wcet" && execution != "random";
  return is_file ? SourceSet::full_path(execution) : execution;
}

}  // namespace jarol
