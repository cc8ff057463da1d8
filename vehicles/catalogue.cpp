#include "vehicles/catalogue.h"

#include "distributers/interfaces/vehicle_class.h"
#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"
#include "vehicles/helicopter/helicopter.h"
#include "vehicles/submarine/submarine.h"
#include "vehicles/submarine/telemetry.h"

namespace jarol::vehicles {
namespace {

VehicleClass submarine() {
  VehicleClass made = vehicle_class<Submarine>("submarine", messages::imc::message_set(),
                                               "torpedo-shaped AUV with four fins and one propeller (LAUV)");
  made.make_telemetry = [](const Vehicle&, messages::Receiver& to) -> std::unique_ptr<messages::Receiver> {
    return std::make_unique<SubmarineTelemetry>(to);
  };
  made.true_state = &messages::imc::SimulatedState::descriptor;
  made.make_announcement = announcement_of;
  return made;
}

}  // namespace

void add_vehicles(NamedList<VehicleClass>& vehicles) {
  vehicles.add(vehicle_class<Helicopter>("helicopter", messages::javiator::message_set(),
                                         "quadrotor with a Robostix between signals and sensors (JAviator)"));
  vehicles.add(submarine());
}

}  // namespace jarol::vehicles
