// How execution times get into a graph's file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graph/language/spec.h"
#include "graph/model/graph.h"

namespace jarol {

/// The text of a graph's file with these WCETs in the graph's tasks, everything else as it was: a value that is there
/// is replaced, else `wcet` follows the task's type. Throws InputError for what can't be edited so.
std::string with_wcets(const std::string& text, const GraphSpec& spec, const Graph& graph,
                       const std::vector<std::optional<Duration>>& wcets);

}  // namespace jarol
