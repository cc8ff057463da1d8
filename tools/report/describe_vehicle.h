// A vehicle's state, inputs, outputs and parameters, for those who write a graph, a script or a parameter file.
#pragma once

#include "distributers/interfaces/vehicle.h"
#include "graph/values/value.h"

namespace jarol::tools {

/// Prints them with their units, ranges and values: as text, or as one JSON object.
void describe_vehicle(const vehicles::VehicleClass& vehicle, const Value& parameters, bool json);

}  // namespace jarol::tools
