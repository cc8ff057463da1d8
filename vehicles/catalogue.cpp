#include "vehicles/catalogue.h"

#include "graph/values/type_of.h"
#include "vehicles/helicopter.h"
#include "vehicles/submarine.h"

namespace jarol::vehicles {
namespace {

template <class V, class Parameters>
VehicleClass entry(std::string name, std::string summary) {
  return {std::move(name), std::move(summary), &type_of<Parameters>(),
          [](const void* parameters) -> std::unique_ptr<Vehicle> {
            return std::make_unique<V>(*static_cast<const Parameters*>(parameters));
          }};
}

}  // namespace

const std::vector<VehicleClass>& catalogue() {
  static const std::vector<VehicleClass> all = {
      entry<Helicopter, HelicopterParameters>("helicopter",
                                              "quadrotor with a Robostix between signals and sensors (JAviator)"),
      entry<Submarine, SubmarineParameters>("submarine", "torpedo-shaped AUV with four fins and one propeller (LAUV)"),
  };
  return all;
}

const VehicleClass* find_vehicle(std::string_view name) {
  for (const VehicleClass& each : catalogue()) {
    if (each.name == name) return &each;
  }
  return nullptr;
}

std::string vehicle_names() {
  std::string names;
  for (const VehicleClass& each : catalogue()) names += (names.empty() ? "" : ", ") + each.name;
  return names;
}

}  // namespace jarol::vehicles
