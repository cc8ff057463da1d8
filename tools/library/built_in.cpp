#include "tools/library/built_in.h"

#include "distributers/distributers.h"
#include "tasks/tasks.h"
#ifdef JAROL_VEHICLES
#include "vehicles/catalogue.h"
#endif

namespace jarol {
namespace {

Registry make_registry() {
  Registry made;
  tasks::add_tasks(made);
  distributers::add_distributers(made);
  return made;
}

}  // namespace

const Registry& built_in_registry() {
  static const Registry known = make_registry();
  return known;
}

const std::vector<vehicles::VehicleClass>& built_in_vehicles() {
#ifdef JAROL_VEHICLES
  return vehicles::catalogue();
#else
  static const std::vector<vehicles::VehicleClass> none;
  return none;
#endif
}

}  // namespace jarol
