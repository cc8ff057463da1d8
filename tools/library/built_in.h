// All that is built in: every task, distributer and vehicle of this tree.
#pragma once

#include "distributers/session/load.h"

namespace jarol {

/// Every task and distributer.
const Registry& built_in_registry();

/// Every vehicle; none where it was built without Simbody.
const std::vector<vehicles::VehicleClass>& built_in_vehicles();

inline Catalogue built_in() { return {built_in_registry(), built_in_vehicles()}; }

}  // namespace jarol
