#include "vehicles/catalogue.h"

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "graph/values/type_of.h"
#include "vehicles/helicopter/helicopter.h"
#include "vehicles/submarine/submarine.h"
#include "vehicles/submarine/telemetry.h"

namespace jarol::vehicles {
namespace {

// A vehicle class names its Parameters, Inputs and Outputs, and the ranges of its inputs.
template <class V>
VehicleClass entry(std::string name, const messages::MessageSet& set, std::string summary) {
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

VehicleClass submarine() {
  VehicleClass made = entry<Submarine>("submarine", messages::imc::message_set(),
                                       "torpedo-shaped AUV with four fins and one propeller (LAUV)");
  made.make_telemetry = [](const Vehicle& vehicle, messages::Receiver& to) -> std::unique_ptr<messages::Receiver> {
    return std::make_unique<SubmarineTelemetry>(vehicle, to);
  };
  made.true_state = &messages::imc::SimulatedState::form;
  return made;
}

}  // namespace

const std::vector<VehicleClass>& catalogue() {
  static const std::vector<VehicleClass> all = {
      entry<Helicopter>("helicopter", messages::javiator::message_set(),
                        "quadrotor with a Robostix between signals and sensors (JAviator)"),
      submarine(),
  };
  return all;
}

const VehicleClass* find_vehicle(std::string_view name) {
  for (const VehicleClass& each : catalogue()) {
    if (each.name == name) return &each;
  }
  return nullptr;
}

}  // namespace jarol::vehicles
