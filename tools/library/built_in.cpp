#include "tools/library/built_in.h"

#include "distributers/distributers.h"
#include "graph/analysis/policies.h"
#include "tasks/tasks.h"
#ifdef JAROL_VEHICLES
#include "vehicles/catalogue.h"
#endif

namespace jarol {
namespace {

distributers::Registries make_registries() {
  distributers::Registries made;
  for (const Grammar& grammar : built_in_grammars()) made.graph.add(grammar);
  analysis::add_policies(made.graph);
  tasks::add_tasks(made.graph);
  distributers::add_distributers(made.graph);
  distributers::add_links(made.links);
#ifdef JAROL_VEHICLES
  vehicles::add_vehicles(made.vehicles);
#endif
  return made;
}

}  // namespace

const distributers::Registries& built_in(const BuildOptions& program) {
  require_built_alike(program);
  static const distributers::Registries known = make_registries();
  return known;
}

}  // namespace jarol
