#include "vehicles/submarine.h"

#include <stdexcept>

#include "distributers/messages/imc.h"
#include "vehicles/submarine_coefficients.h"
#include "vehicles/submarine_plant.h"
#include "vehicles/vsim_plant.h"

namespace jarol::vehicles {
namespace {

constexpr double step_seconds = SubmarineMotion::step_seconds;

VehicleState start_of(const SubmarineParameters& parameters) {
  VehicleState start;
  start.x = parameters.start.north;
  start.y = parameters.start.east;
  start.z = calc_floating_depth(make_body(parameters).hull) + parameters.start.depth;
  start.psi = parameters.start.heading;
  start.u = parameters.start.surge;
  return start;
}

}  // namespace

Submarine::Submarine(const SubmarineParameters& parameters, std::uint64_t)
    : parameters_(parameters), actuation_(parameters) {
  Submarine::place(start_of(parameters));
}

Submarine::~Submarine() = default;

std::chrono::nanoseconds Submarine::grid() const { return std::chrono::milliseconds(10); }

void Submarine::accept(messages::MessageRef command) {
  namespace imc = messages::imc;
  if (const auto* thruster = command.as<imc::SetThrusterActuation>()) {
    if (thruster->id == 0) actuation_.command_thruster(static_cast<double>(thruster->value));
  } else if (const auto* servo = command.as<imc::SetServoPosition>()) {
    actuation_.command_servo(servo->id, static_cast<double>(servo->value));
  }
}

void Submarine::command(const void* inputs) {
  const auto& in = *static_cast<const SubmarineInputs*>(inputs);
  actuation_.command_thruster(in.thruster);
  const double fins[] = {in.fin0, in.fin1, in.fin2, in.fin3};
  for (std::size_t i = 0; i < 4; ++i) actuation_.command_servo(i, fins[i]);
}

void Submarine::step() {
  motion_->step(actuation_.step());
  ++steps_;
  at_ = motion_->state();
  const auto& servos = actuation_.servos();
  outputs_.actuators = {actuation_.propeller(), servos[0], servos[1], servos[2], servos[3]};
}

// the plant moves in water that the current carries along
VehicleState Submarine::state() const {
  const double t = static_cast<double>(steps_) * step_seconds;
  return {at_.eta[0] + parameters_.sea.current_north * t,
          at_.eta[1] + parameters_.sea.current_east * t,
          at_.eta[2],
          at_.eta[3],
          at_.eta[4],
          at_.eta[5],
          at_.nu[0],
          at_.nu[1],
          at_.nu[2],
          at_.nu[3],
          at_.nu[4],
          at_.nu[5]};
}

void Submarine::place(const VehicleState& s) {
  PlantState start;
  start.eta = {s.x, s.y, s.z, s.phi, s.theta, s.psi};
  start.nu = {s.u, s.v, s.w, s.p, s.q, s.r};
  const SeaParameters& sea = parameters_.sea;
  if (parameters_.vsim_compatible) {
    motion_ = std::make_unique<VsimPlant>(parameters_, start);
  } else {
    const Waves waves(sea.wave_height, sea.wave_period, sea.wave_direction);
    motion_ = std::make_unique<SubmarinePlant>(make_body(parameters_), waves, start);
  }
  at_ = start;
}

void Submarine::sense(messages::Receiver& receiver) const {
  const VehicleState at = state();
  const SeaParameters& sea = parameters_.sea;
  messages::imc::SimulatedState m;
  m.lat = sea.latitude;
  m.lon = sea.longitude;
  m.x = static_cast<float>(at.x);
  m.y = static_cast<float>(at.y);
  m.z = static_cast<float>(at.z);
  m.phi = static_cast<float>(at.phi);
  m.theta = static_cast<float>(at.theta);
  m.psi = static_cast<float>(at.psi);
  m.u = static_cast<float>(at.u);
  m.v = static_cast<float>(at.v);
  m.w = static_cast<float>(at.w);
  m.p = static_cast<float>(at.p);
  m.q = static_cast<float>(at.q);
  m.r = static_cast<float>(at.r);
  m.svx = static_cast<float>(sea.current_north);
  m.svy = static_cast<float>(sea.current_east);
  receiver.receive(messages::refer_to(m));
}

}  // namespace jarol::vehicles
