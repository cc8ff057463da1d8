// The option --execution of runs on the virtual clock.
#pragma once

#include <string>

#include "graph/model/graph.h"

namespace jarol::tools {

class Command;

void add_execution_option(Command& command, std::string& execution);
/// It says nothing on the real clock.
void require_execution_effect(const Command& command, bool virtual_clock);

/// A line of the report: "  execution   random, by table on one core"; empty: none was asked for.
std::string execution_text(const std::string& execution, const Graph& graph);

}  // namespace jarol::tools
