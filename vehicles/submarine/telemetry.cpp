#include "vehicles/submarine/telemetry.h"

#include <cmath>

#include "distributers/messages/imc_announce.h"
#include "graph/math/geometry.h"
#include "graph/math/rotations.h"

namespace jarol::vehicles {
namespace imc = messages::imc;
namespace {

constexpr std::int64_t states_a_second = 100;

Eigen::Matrix3d attitude_of(const imc::SimulatedState& s) { return rotation_of(s.phi, s.theta, s.psi); }

}  // namespace

// more than a device's readings where DUNE has two that report the same
SubmarineTelemetry::SubmarineTelemetry(messages::Receiver& to)
    : to_(to),
      readings_{{{&imc::Depth::descriptor, 16},
                 {&imc::Pressure::descriptor, 6},
                 {&imc::Conductivity::descriptor, 6},
                 {&imc::Salinity::descriptor, 6},
                 {&imc::Temperature::descriptor, 7},
                 {&imc::SoundSpeed::descriptor, 8},
                 {&imc::WaterVelocity::descriptor, 5}}} {}

void SubmarineTelemetry::receive(messages::MessageRef message) {
  const auto* truth = message.as<imc::SimulatedState>();
  if (truth == nullptr) {
    // what an entity of its own reports is not what another does
    if (message.header != nullptr || !keep(message)) to_.receive(message);
    return;
  }
  ++states_;
  report_readings();  // that came with the state before
  to_.receive(message);
  if (is_due(20)) report_estimate(*truth);
  if (is_due(5)) report_water(*truth);
  if (is_due(1)) {
    to_.receive(messages::refer_to(imc::EstimatedStreamVelocity{truth->svx, truth->svy, truth->svz}));
    to_.receive(messages::refer_to(imc::Heartbeat{}));
  }
}

// Is it one more of `rate` within the second?
bool SubmarineTelemetry::is_due(std::int64_t rate) const {
  return states_ * rate / states_a_second != (states_ - 1) * rate / states_a_second;
}

bool SubmarineTelemetry::keep(messages::MessageRef message) {
  for (Reading& reading : readings_) {
    if (message.descriptor != reading.descriptor) continue;
    reading.interval = reading.newest.descriptor() == nullptr ? states_a_second : states_ - reading.at;
    reading.at = states_;
    reading.newest = messages::Message(message);
    return true;
  }
  return false;
}

void SubmarineTelemetry::report_readings() {
  for (const Reading& reading : readings_) {
    const bool overdue = 2 * (states_ - reading.at) > 3 * reading.interval;
    if (reading.newest.descriptor() != nullptr && !overdue && is_due(reading.rate)) to_.receive(reading.newest);
  }
}

void SubmarineTelemetry::report_estimate(const imc::SimulatedState& s) {
  imc::EstimatedState e;
  e.lat = s.lat;
  e.lon = s.lon;
  e.height = s.height;
  e.x = s.x;
  e.y = s.y;
  e.z = e.depth = s.z;
  e.phi = s.phi;
  e.theta = s.theta;
  e.psi = s.psi;
  e.u = s.u;
  e.v = s.v;
  e.w = s.w;
  // over ground: the velocity through the water, and the current
  const Eigen::Vector3f v_n =
      (attitude_of(s) * Eigen::Vector3d(s.u, s.v, s.w) + Eigen::Vector3d(s.svx, s.svy, s.svz)).cast<float>();
  e.vx = v_n.x();
  e.vy = v_n.y();
  e.vz = v_n.z();
  e.p = s.p;
  e.q = s.q;
  e.r = s.r;
  e.alt = -1;
  to_.receive(messages::refer_to(e));
}

void SubmarineTelemetry::report_water(const imc::SimulatedState& s) {
  using Validity = imc::GroundVelocity::Validity;
  const Eigen::Vector3d v_b =
      Eigen::Vector3d(s.u, s.v, s.w) + attitude_of(s).transpose() * Eigen::Vector3d(s.svx, s.svy, s.svz);
  to_.receive(messages::refer_to(
      imc::GroundVelocity{Validity::VEL_X | Validity::VEL_Y | Validity::VEL_Z, v_b.x(), v_b.y(), v_b.z()}));
}

messages::Message announcement_of(const Vehicle& vehicle, const std::string& address) {
  struct Truth : messages::Receiver {
    void receive(messages::MessageRef message) override {
      if (const auto* state = message.as<imc::SimulatedState>()) at = *state;
    }
    imc::SimulatedState at;
  } truth;
  vehicle.sense(truth);
  const EarthRadii radii = earth_radii(truth.at.lat);
  const imc::Announce announce = imc::make_announce({.name = "lauv-simulator-1",
                                                     .type = imc::SystemType::UUV,
                                                     .latitude = truth.at.lat + truth.at.x / radii.north,
                                                     .longitude = wrapped(truth.at.lon + truth.at.y / radii.east),
                                                     .address = address});
  return messages::Message(messages::refer_to(announce));
}

}  // namespace jarol::vehicles
