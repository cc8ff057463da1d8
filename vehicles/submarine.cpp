#include "vehicles/submarine.h"

#include <algorithm>
#include <cmath>

#include "distributers/messages/imc.h"
#include "vehicles/submarine_coefficients.h"
#include "vehicles/submarine_plant.h"

namespace jarol::vehicles {
namespace {

constexpr double step_seconds = SubmarinePlant::step_seconds;

std::unique_ptr<SubmarinePlant> make_plant(const SubmarineParameters& parameters) {
  const SubmarineBody body = make_body(parameters);
  PlantState start;
  start.eta[0] = parameters.start.north;
  start.eta[1] = parameters.start.east;
  start.eta[2] = calc_floating_depth(body.hull) + parameters.start.depth;
  start.eta[5] = parameters.start.heading;
  start.nu[0] = parameters.start.surge;
  return std::make_unique<SubmarinePlant>(body, start);
}

}  // namespace

Submarine::Submarine(const SubmarineParameters& parameters) : parameters_(parameters), plant_(make_plant(parameters)) {}

Submarine::~Submarine() = default;

std::chrono::nanoseconds Submarine::grid() const { return std::chrono::milliseconds(10); }

void Submarine::accept(messages::MessageRef command) {
  namespace imc = messages::imc;
  if (const auto* thruster = command.as<imc::SetThrusterActuation>()) {
    if (thruster->thruster != 0 || !std::isfinite(thruster->value)) return;
    thruster_command_ = std::clamp(static_cast<double>(thruster->value), -1.0, 1.0);
  } else if (const auto* servo = command.as<imc::SetServoPosition>()) {
    if (servo->servo >= servo_commands_.size() || !std::isfinite(servo->value)) return;
    const double limit = parameters_.servos.limit;
    servo_commands_[servo->servo] = std::clamp(static_cast<double>(servo->value), -limit, limit);
  }
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
}

void Submarine::sense(messages::Receiver& receiver) const {
  const PlantState state = plant_->state();
  const double t = static_cast<double>(steps_) * step_seconds;
  const SeaParameters& sea = parameters_.sea;

  // a uniform current carries all the water along: the plant moves in it as in water at rest
  messages::imc::SimulatedState m;
  m.lat = sea.latitude;
  m.lon = sea.longitude;
  m.x = static_cast<float>(state.eta[0] + sea.current_north * t);
  m.y = static_cast<float>(state.eta[1] + sea.current_east * t);
  m.z = static_cast<float>(state.eta[2]);
  m.phi = static_cast<float>(state.eta[3]);
  m.theta = static_cast<float>(state.eta[4]);
  m.psi = static_cast<float>(state.eta[5]);
  m.u = static_cast<float>(state.nu[0]);
  m.v = static_cast<float>(state.nu[1]);
  m.w = static_cast<float>(state.nu[2]);
  m.p = static_cast<float>(state.nu[3]);
  m.q = static_cast<float>(state.nu[4]);
  m.r = static_cast<float>(state.nu[5]);
  m.svx = static_cast<float>(sea.current_north);
  m.svy = static_cast<float>(sea.current_east);
  receiver.receive(messages::refer_to(m));
}

}  // namespace jarol::vehicles
