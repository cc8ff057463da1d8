#include "vehicles/submarine/submarine.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "distributers/messages/imc.h"
#include "graph/math/rotations.h"
#include "graph/text/errors.h"
#include "vehicles/submarine/coefficients.h"
#include "vehicles/submarine/plant.h"
#include "vehicles/submarine/rigid_plant.h"
#include "vehicles/submarine/vsim_plant.h"

namespace jarol::vehicles {
namespace {

double floating_depth(const SubmarineParameters& parameters) { return calc_floating_depth(make_body(parameters).hull); }

VehicleState start_of(const SubmarineParameters& parameters) {
  VehicleState start;
  start.x = parameters.start.north;
  start.y = parameters.start.east;
  start.z = floating_depth(parameters) + parameters.start.depth;
  if (!parameters.vsim_compatible && start.z + 0.5 * parameters.hull.diameter > parameters.sea.floor)
    throw InputError(fmt::format("submarine: start.depth must lie above sea.floor, and is {} m where that is {} m",
                                 parameters.start.depth, parameters.sea.floor));
  start.psi = parameters.start.heading;
  start.u = parameters.start.surge;
  return start;
}

}  // namespace

Submarine::Submarine(const SubmarineParameters& parameters, std::uint64_t seed)
    : parameters_(parameters),
      seed_(seed),
      actuation_(parameters, seed),
      sensors_(parameters.sensors, parameters.sea, floating_depth(parameters), seed),
      power_(parameters.power),
      waves_(parameters.sea.wave_height, parameters.sea.wave_period, parameters.sea.wave_direction),
      judge_(parameters, start_of(parameters)) {
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
  } else if (const auto* position = command.as<imc::ServoPosition>()) {
    // what DUNE's servos have come to where it has no plant of its own
    actuation_.command_servo(position->id, static_cast<double>(position->value));
  }
}

void Submarine::serialize(Archive& archive) {
  motion_->serialize(archive);
  archive(actuation_, sensors_, power_, at_, steps_, outputs_, judge_);
}

void Submarine::command(const void* inputs) {
  const auto& in = *static_cast<const SubmarineInputs*>(inputs);
  actuation_.command_thruster(in.thruster);
  const double fins[] = {in.fin0, in.fin1, in.fin2, in.fin3};
  for (std::size_t i = 0; i < 4; ++i) actuation_.command_servo(i, fins[i]);
}

void Submarine::step() {
  motion_->step(actuation_.step(!power_.is_flat()));
  ++steps_;
  at_ = motion_->state();
  const auto& servos = actuation_.servos();
  outputs_.actuators = {actuation_.propeller(), servos[0], servos[1], servos[2], servos[3]};
  judge_.look(steps_ * grid(), state());
  power_.draw(actuation_.propeller() / parameters_.thruster.full_speed, SubmarineMotion::step_seconds);
  sample();
}

void Submarine::sample() {
  const VehicleState over_ground = state();
  const fossen::Vector6& eta = at_.eta;
  const double t = static_cast<double>(steps_) * SubmarineMotion::step_seconds;
  const Water water = waves_.at({eta[0], eta[1], eta[2]}, t);

  SubmarineScene scene;
  scene.at = at_;
  scene.north = over_ground.x;
  scene.east = over_ground.y;
  scene.depth = eta[2] - water.surface;
  scene.head = water.head;
  const fossen::Vector3& v_n = water.velocity_n;
  const Eigen::Vector3d v_b = rotation_of(eta[3], eta[4], eta[5]).transpose() * Eigen::Vector3d(v_n[0], v_n[1], v_n[2]);
  scene.water_b = {v_b[0], v_b[1], v_b[2]};
  scene.rpm = actuation_.propeller() * 30.0 / std::numbers::pi;
  scene.leak = parameters_.leak_at > Duration{} && steps_ * grid() >= parameters_.leak_at;
  scene.hull_warmth = power_.warmth();
  scene.voltage = power_.voltage();
  scene.current = power_.current();
  scene.servos = actuation_.servos();
  sensors_.step(steps_, scene);
  outputs_.sensors = sensors_.readings();
  outputs_.hull = sensors_.hull_readings();
}

// the plant moves in water that the current carries along
VehicleState Submarine::state() const {
  const double t = static_cast<double>(steps_) * SubmarineMotion::step_seconds;
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
  if (parameters_.vsim_compatible) {
    motion_ = std::make_unique<VsimPlant>(parameters_, start);
  } else if (parameters_.dynamics == Dynamics::rigid) {
    motion_ = std::make_unique<RigidSubmarine>(make_body(parameters_), waves_, start);
  } else {
    motion_ = std::make_unique<SubmarinePlant>(make_body(parameters_), waves_, start);
  }
  at_ = motion_->state();
  judge_ = SubmarineJudge(parameters_, s);
  // what the sensors report at the start; they begin anew
  sensors_ = SubmarineSensors(parameters_.sensors, parameters_.sea, floating_depth(parameters_), seed_);
  sample();
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
  sensors_.report(receiver);
}

}  // namespace jarol::vehicles
