// The vehicles of this folder.
#pragma once

#include "distributers/interfaces/vehicle.h"
#include "graph/named_list.h"

namespace jarol::vehicles {

/// Adds every vehicle of this folder.
void add_vehicles(NamedList<VehicleClass>& vehicles);

}  // namespace jarol::vehicles
