#include "distributers/session/true_state.h"

namespace jarol {

std::vector<TrueState> find_true_states(const Graph& graph, const std::vector<ExternalSystem*>& channels) {
  std::vector<TrueState> found;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Type* type = channels[i]->true_type();
    if (type == nullptr) continue;
    found.push_back({graph.distributers[i].name, Value(*type)});
    channels[i]->copy_true_values(found.back().values.data());
  }
  return found;
}

}  // namespace jarol
