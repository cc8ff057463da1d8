#include "distributers/lauv_vehicle.h"

#include "distributers/messages/imc.h"

namespace jarol::distributers {
namespace imc = messages::imc;

DistributerClass LauvVehicle::describe_class() {
  return {"LauvVehicle",
          "the submarine, over IMC",
          {{"motion", Direction::in, &type_of<tasks::Motion>(), "position, attitude and velocities"},
           {"actuation", Direction::out, &type_of<tasks::Actuation>(), "commands for propeller and fins"}}};
}

DistributerClass describe_lauv_operator() {
  return {"LauvOperator",
          "the submarine's operator",
          {{"setpoint", Direction::in, &type_of<tasks::Setpoint>(), "commanded depth, heading and speed"},
           {"actuation", Direction::in, &type_of<tasks::Actuation>(), "propeller and fins, steered by hand"},
           {"report", Direction::out, &type_of<tasks::VehicleReport>(), "depth, pitch, heading and speed reached"},
           {"motion", Direction::out, &type_of<tasks::Motion>(), "the vehicle's motion as it came"}}};
}

const messages::MessageSet& LauvVehicle::message_set() const { return imc::message_set(); }

void LauvVehicle::receive(messages::MessageRef message) {
  const auto* s = message.as<imc::SimulatedState>();
  if (s == nullptr) return;
  motion_ = {s->x, s->y, s->z, s->phi, s->theta, s->psi, s->u, s->v, s->w, s->p, s->q, s->r};
  fresh_ = true;
}

bool LauvVehicle::take(std::size_t, void* value) {
  if (!fresh_) return false;
  *static_cast<tasks::Motion*>(value) = motion_;
  fresh_ = false;
  return true;
}

void LauvVehicle::hand_over(std::size_t, const void* value, messages::Receiver& system) {
  const auto& actuation = *static_cast<const tasks::Actuation*>(value);
  system.receive(messages::refer_to(imc::SetThrusterActuation{0, static_cast<float>(actuation.thruster)}));
  for (std::uint8_t i = 0; i < actuation.fins.size(); ++i)
    system.receive(messages::refer_to(imc::SetServoPosition{i, static_cast<float>(actuation.fins[i])}));
}

}  // namespace jarol::distributers
