#include "vehicles/submarine.h"

#include <algorithm>
#include <cmath>

#include "distributers/messages/imc.h"
#include "vehicles/submarine_coefficients.h"
#include "vehicles/submarine_plant.h"

namespace jarol::vehicles {
namespace {

constexpr double step_seconds = SubmarinePlant::step_seconds;

VehicleState start_of(const SubmarineParameters& parameters, const SubmarineBody& body) {
  VehicleState start;
  start.x = parameters.start.north;
  start.y = parameters.start.east;
  start.z = calc_floating_depth(body.hull) + parameters.start.depth;
  start.psi = parameters.start.heading;
  start.u = parameters.start.surge;
  return start;
}

}  // namespace

Submarine::Submarine(const SubmarineParameters& parameters, std::uint64_t)
    : parameters_(parameters), body_(make_body(parameters)) {
  Submarine::place(start_of(parameters, body_));
}

Submarine::~Submarine() = default;

std::chrono::nanoseconds Submarine::grid() const { return std::chrono::milliseconds(10); }

void Submarine::command_thruster(double actuation) {
  if (!std::isfinite(actuation)) return;
  thruster_command_ = std::clamp(actuation, -1.0, 1.0);
}

void Submarine::command_servo(std::size_t servo, double angle) {
  if (servo >= servo_commands_.size() || !std::isfinite(angle)) return;
  const double limit = parameters_.servos.limit;
  servo_commands_[servo] = std::clamp(angle, -limit, limit);
}

void Submarine::accept(messages::MessageRef command) {
  namespace imc = messages::imc;
  if (const auto* thruster = command.as<imc::SetThrusterActuation>()) {
    if (thruster->id == 0) command_thruster(static_cast<double>(thruster->value));
  } else if (const auto* servo = command.as<imc::SetServoPosition>()) {
    command_servo(servo->id, static_cast<double>(servo->value));
  }
}

void Submarine::command(const void* inputs) {
  const auto& in = *static_cast<const SubmarineInputs*>(inputs);
  command_thruster(in.thruster);
  const double fins[] = {in.fin0, in.fin1, in.fin2, in.fin3};
  for (std::size_t i = 0; i < 4; ++i) command_servo(i, fins[i]);
}

void Submarine::step() {
  // the plant sees what the actuators are on average over the step
  SubmarineInput input;
  const double reach = parameters_.servos.slew * step_seconds;
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    const double before = servos_[i];
    servos_[i] += std::clamp(servo_commands_[i] - before, -reach, reach);
    input.fins[i] = 0.5 * (before + servos_[i]);
  }

  // first-order lag, solved exactly
  const ThrusterParameters& thruster = parameters_.thruster;
  const double command = thruster_command_ * thruster.full_speed;
  const double before = propeller_;
  propeller_ = command + (before - command) * std::exp(-step_seconds / thruster.time_constant);
  const double n = 0.5 * (before + propeller_);
  input.thrust = std::clamp(thruster.thrust_coefficient * n * std::abs(n), -thruster.max_thrust, thruster.max_thrust);

  plant_->step(input);
  ++steps_;
  outputs_.actuators = {propeller_, servos_[0], servos_[1], servos_[2], servos_[3]};
}

// a uniform current carries all the water along: the plant moves in it as in water at rest
VehicleState Submarine::state() const {
  const PlantState at = plant_->state();
  const double t = static_cast<double>(steps_) * step_seconds;
  return {at.eta[0] + parameters_.sea.current_north * t,
          at.eta[1] + parameters_.sea.current_east * t,
          at.eta[2],
          at.eta[3],
          at.eta[4],
          at.eta[5],
          at.nu[0],
          at.nu[1],
          at.nu[2],
          at.nu[3],
          at.nu[4],
          at.nu[5]};
}

void Submarine::place(const VehicleState& s) {
  plant_ = std::make_unique<SubmarinePlant>(
      body_, PlantState{{s.x, s.y, s.z, s.phi, s.theta, s.psi}, {s.u, s.v, s.w, s.p, s.q, s.r}});
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
