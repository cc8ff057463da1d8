// Which outputs of a graph are recorded.
#pragma once

#include <string>
#include <vector>

#include "graph/model/graph.h"
#include "runtime/plan/output.h"

namespace jarol {

/// An output, and when it is published.
struct SelectedOutput : Output {
  Duration period{}, phase{};  // it is published so long after multiples of the period
  bool selected = false;
};

/// All outputs_of the graph. `what`: "all", "inputs" for none of them, or names with * for any part, as in
/// "depth.*,from_dune". Throws InputError where one fits nothing.
std::vector<SelectedOutput> select_outputs(const Graph& graph, const std::string& what);

}  // namespace jarol
