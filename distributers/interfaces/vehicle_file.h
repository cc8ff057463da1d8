// A vehicle's file: which vehicle, and what its parameters are.
#pragma once

#include <optional>

#include "distributers/interfaces/vehicle.h"
#include "graph/language/yaml.h"
#include "graph/named_list.h"
#include "graph/values/value.h"

namespace jarol::distributers {

struct VehicleFile {
  const vehicles::VehicleClass* vehicle = nullptr;
  Value parameters;
};

/// What is wrong goes to `problems`; nothing is returned then.
std::optional<VehicleFile> read_vehicle_file(const std::shared_ptr<const Source>& source,
                                             const NamedList<vehicles::VehicleClass>& known, Problems& problems);

}  // namespace jarol::distributers
