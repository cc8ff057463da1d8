#include "distributers/session/checked_graph.h"

namespace jarol {

CheckedGraph check_graph(const std::shared_ptr<const Source>& source, const distributers::Registries& known,
                         const CheckOptions& options) {
  CheckedGraph checked{load_graph(source, known, options.overrides, 0, options.note), {}, {}};
  checked.found = analysis::check_graph(*checked.loaded.graph, options.sensitivity, options.all_chains);
  if (!options.remedies) return checked;
  const auto loads = [&](const Overrides& overrides) {
    try {
      load_graph(source, known, overrides, 0, no_notes);  // its notes are of graphs that nobody has asked about
      return true;
    } catch (const SpecError&) { return false; }
  };
  analysis::Budget budget;
  if (!options.sensitivity) budget.left = 30'000'000;
  checked.remedies =
      analysis::find_remedies(source, options.overrides, checked.loaded.known->graph, checked.found, loads, budget);
  return checked;
}

}  // namespace jarol
