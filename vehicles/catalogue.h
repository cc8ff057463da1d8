// The vehicles there are, by name, with the type of their parameters.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "distributers/interfaces/vehicle.h"

namespace jarol::vehicles {

const std::vector<VehicleClass>& catalogue();

/// The class of that name, or null.
const VehicleClass* find_vehicle(std::string_view name);

}  // namespace jarol::vehicles
