// The class of a vehicle, made of the vehicle's own type.
#pragma once

#include <string>

#include "distributers/interfaces/vehicle.h"
#include "graph/values/type_of.h"

namespace jarol::vehicles {

/// V is a Vehicle that names its Parameters, Inputs, Outputs and Truth, described structs, and in `Inputs::ranges()`
/// what each input may be; it is made of its parameters and a seed.
template <class V>
VehicleClass vehicle_class(std::string name, const messages::MessageSet& set, std::string summary) {
  static_assert(std::is_base_of_v<Vehicle, V>, "a vehicle is derived from jarol::vehicles::Vehicle");
  VehicleClass made;
  made.message_set = &set;
  made.name = std::move(name);
  made.summary = std::move(summary);
  made.parameters = &type_of<typename V::Parameters>();
  made.inputs = &type_of<typename V::Inputs>();
  made.ranges = V::Inputs::ranges();
  made.outputs = &type_of<typename V::Outputs>();
  made.truth = &type_of<typename V::Truth>();
  made.make = [](const void* parameters, std::uint64_t seed) -> std::unique_ptr<Vehicle> {
    return std::make_unique<V>(*static_cast<const typename V::Parameters*>(parameters), seed);
  };
  return made;
}

}  // namespace jarol::vehicles
