#include "tools/commands/run/execution.h"

#include <stdexcept>

#include "graph/analysis/execution_times.h"
#include "graph/analysis/policies.h"
#include "graph/language/source_set.h"
#include "graph/text/escape.h"
#include "tools/report/command_line.h"

namespace jarol::tools {
namespace {

using analysis::ExecutionTimes;

ExecutionTimes read_times(const Graph& graph, const std::shared_ptr<const Source>& source, std::uint64_t seed) {
  Problems problems;
  ExecutionTimes times = ExecutionTimes::read(graph, source, seed, problems);
  problems.throw_if_any();
  return times;
}

}  // namespace

void add_execution_option(Command& command, std::string& execution) {
  command
      .add_option("--execution", execution,
                  "On the virtual clock, what activations take, so that the schedule of 'platform' has some of them "
                  "late: wcet, random (by --seed), or a YAML file, as in 'depth: 80us..2ms'")
      ->suggests({"wcet", "random"});
}

void require_execution_effect(const Command& command, bool virtual_clock) {
  if (!virtual_clock)
    command.refuse({"--execution"}, "belongs to the virtual clock; on the real one tasks take their time");
}

Execution::Execution(const std::string& execution, const Graph& graph, std::uint64_t seed) {
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
  } catch (const std::invalid_argument& wrong) {
    throw std::invalid_argument(std::string("--execution: ") + wrong.what());
  }
}

std::string recorded_execution(const std::string& execution) {
  const bool is_file = !execution.empty() && execution != "wcet" && execution != "random";
  return is_file ? SourceSet::full_path(execution) : execution;
}

std::string execution_text(const std::string& execution, const Graph& graph) {
  if (execution.empty()) return "";
  const std::int64_t cores = graph.platform.cores;
  return "  execution   " + printable(execution) + ", by " + std::string(analysis::policy_of(graph.platform).name) +
         " on " + (cores == 1 ? "one core" : std::to_string(cores) + " cores") + "\n";
}

}  // namespace jarol::tools
