#include "tools/commands/run/execution.h"

#include "graph/analysis/policies.h"
#include "graph/text/escape.h"
#include "tools/report/command_line.h"

namespace jarol::tools {
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

std::string execution_text(const std::string& execution, const Graph& graph) {
  if (execution.empty()) return "";
  const std::int64_t cores = graph.platform.cores;
  return "  execution   " + printable(execution) + ", by " + std::string(analysis::policy_of(graph.platform).name) +
         " on " + (cores == 1 ? "one core" : std::to_string(cores) + " cores") + "\n";
}

}  // namespace jarol::tools
