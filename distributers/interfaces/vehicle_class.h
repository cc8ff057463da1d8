// The class of a vehicle, made of the vehicle's own type.
#pragma once

#include <stdexcept>
#include <string>

#include "distributers/interfaces/vehicle.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "graph/values/bind.h"
#include "graph/values/type_of.h"

namespace jarol::vehicles {
namespace detail {

// Each input is a double and has its range.
inline void require_inputs(const VehicleClass& vehicle) {
  const std::string who = "vehicle '" + vehicle.name + "' ";
  const std::vector<Leaf> inputs = leaves_of(*vehicle.inputs);
  for (const Leaf& input : inputs)
    if (input.type->kind != Kind::floating || input.type->size != sizeof(double))
      throw InputError(who + "has an input '" + input.path + "' of type " + input.type->name +
                       "; an input is a double");
  if (inputs.size() != vehicle.ranges.size())
    throw InputError(who + "has another number of ranges (" + std::to_string(vehicle.ranges.size()) +
                     ") than of inputs (" + std::to_string(inputs.size()) +
                     "); Inputs::ranges() gives one for each, in their order");
  for (std::size_t i = 0; i < inputs.size(); ++i)
    if (const Range& range = vehicle.ranges[i]; !(range.min <= range.max))
      throw InputError(who + "has an input '" + inputs[i].path + "' from " + number_text(range.min) + " to " +
                       number_text(range.max) + "; Inputs::ranges() gives the smaller end first");
}

// What the rest of Jarol relies on.
inline void require_sound(const Vehicle& vehicle, const Type& truth) {
  if (const auto grid = vehicle.grid(); grid <= std::chrono::nanoseconds{})
    throw InputError("its grid() is " + duration_text(grid) + "; a step has a length above zero, as in 10ms");
  if (vehicle.true_type() == nullptr || !same_type(*vehicle.true_type(), truth))
    throw InputError("its true_type() is not that of its Truth; it returns &jarol::type_of<Truth>()");
  if (vehicle.true_values() == nullptr)
    throw InputError("its true_values() is null; it returns the address of its Truth");
  if (vehicle.outputs() == nullptr) throw InputError("its outputs() is null; it returns the address of its Outputs");
}

}  // namespace detail

/// V is a Vehicle that names its Parameters, Inputs, Outputs and Truth, described structs, and in `Inputs::ranges()`
/// what each input may be; it is made of its parameters and a seed. Throws InputError where the ranges are
/// not those of the inputs.
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
  detail::require_inputs(made);
  made.make = [](const void* parameters, std::uint64_t seed) -> std::unique_ptr<Vehicle> {
    std::unique_ptr<Vehicle> vehicle;
    try {
      vehicle = std::make_unique<V>(*static_cast<const typename V::Parameters*>(parameters), seed);
    } catch (const std::exception&) { throw; } catch (...) {
      throw InputError("its constructor throws what is no std::exception");
    }
    detail::require_sound(*vehicle, type_of<typename V::Truth>());
    return vehicle;
  };
  return made;
}

}  // namespace jarol::vehicles
