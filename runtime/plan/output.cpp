#include "runtime/plan/output.h"

#include <algorithm>

#include "graph/model/graph.h"

namespace jarol {

std::vector<Output> outputs_of(const Graph& graph) {
  std::vector<Output> outputs;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const auto& fields = graph.tasks[i].task_class->out->fields;
    for (std::size_t f = 0; f < fields.size(); ++f)
      outputs.push_back({end_name(graph, {End::Kind::task, i, f}, true), fields[f].type});
  }
  for (const Communicator& c : graph.communicators) outputs.push_back({c.name, c.type});
  std::sort(outputs.begin(), outputs.end(), [](const Output& a, const Output& b) { return a.name < b.name; });
  return outputs;
}

}  // namespace jarol
