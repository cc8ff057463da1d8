// A vehicle's file: which vehicle, and what its parameters are.
#pragma once

#include <optional>

#include "graph/values/value.h"
#include "graph/yaml/yaml.h"
#include "vehicles/vehicle.h"

namespace jarol::distributers {

struct VehicleFile {
  const vehicles::VehicleClass* vehicle = nullptr;
  Value parameters;
};

/// What is wrong goes to `problems`; nothing is returned then.
std::optional<VehicleFile> read_vehicle_file(const std::shared_ptr<const Source>& source,
                                             const std::vector<vehicles::VehicleClass>& known, Problems& problems);

}  // namespace jarol::distributers
