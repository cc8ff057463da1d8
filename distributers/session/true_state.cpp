#include "distributers/session/true_state.h"

namespace jarol {

std::vector<TrueState> find_true_states(const Graph& graph, const std::vector<ExternalSystem*>& systems) {
  std::vector<TrueState> found;
  for (std::size_t i = 0; i < systems.size(); ++i) {
    const Type* type = systems[i]->true_type();
    if (type == nullptr) continue;
    found.push_back({graph.distributers[i].name, Value(*type)});
    systems[i]->copy_true_values(found.back().values.data());
  }
  return found;
}

}  // namespace jarol
