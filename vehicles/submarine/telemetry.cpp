#include "vehicles/submarine/telemetry.h"

#include <cmath>

#include "distributers/messages/imc_announce.h"
#include "graph/math/geometry.h"
#include "vehicles/submarine/io.h"

namespace jarol::vehicles {
namespace imc = messages::imc;
namespace {

constexpr std::int64_t states_a_second = 100;

// Body-fixed components of a velocity in the earth frame: R_nb of Euler angles ZYX, transposed.
std::array<double, 3> to_body(const imc::SimulatedState& s, double north, double east, double down) {
  const double c_psi = std::cos(s.psi), s_psi = std::sin(s.psi), c_theta = std::cos(s.theta),
               s_theta = std::sin(s.theta), c_phi = std::cos(s.phi), s_phi = std::sin(s.phi);
  const double along = c_psi * north + s_psi * east, across = c_psi * east - s_psi * north;
  const double below = s_theta * along + c_theta * down;
  return {c_theta * along - s_theta * down, c_phi * across + s_phi * below, c_phi * below - s_phi * across};
}

}  // namespace

// more than a device's readings where DUNE has two that tell the same
SubmarineTelemetry::SubmarineTelemetry(const Vehicle& vehicle, messages::Receiver& to)
    : vehicle_(vehicle),
      to_(to),
      readings_{{{&imc::Depth::form, 16},
                 {&imc::Pressure::form, 6},
                 {&imc::Conductivity::form, 6},
                 {&imc::Salinity::form, 6},
                 {&imc::Temperature::form, 7},
                 {&imc::SoundSpeed::form, 8},
                 {&imc::WaterVelocity::form, 5},
                 {&imc::EntityState::form, 30}}} {}

void SubmarineTelemetry::receive(messages::MessageRef message) {
  const auto* truth = message.as<imc::SimulatedState>();
  if (truth == nullptr) {
    if (!keep(message)) to_.receive(message);
    return;
  }
  ++states_;
  tell_readings();  // that came with the state before
  to_.receive(message);
  tell_servos();
  if (is_due(20)) tell_estimate(*truth);
  if (is_due(5)) tell_water(*truth);
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
    if (message.form != reading.form) continue;
    reading.interval = reading.newest.form() == nullptr ? states_a_second : states_ - reading.at;
    reading.at = states_;
    reading.newest = messages::Message(message);
    return true;
  }
  return false;
}

void SubmarineTelemetry::tell_readings() {
  for (const Reading& reading : readings_) {
    const bool overdue = 2 * (states_ - reading.at) > 3 * reading.interval;
    if (reading.newest.form() != nullptr && !overdue && is_due(reading.rate)) to_.receive(reading.newest);
  }
}

void SubmarineTelemetry::tell_servos() {
  const SubmarineActuators& a = static_cast<const SubmarineOutputs*>(vehicle_.outputs())->actuators;
  const double fins[] = {a.fin0, a.fin1, a.fin2, a.fin3};
  for (std::uint8_t i = 0; i < 4; ++i)
    to_.receive(messages::refer_to(imc::ServoPosition{i, static_cast<float>(fins[i])}));
}

void SubmarineTelemetry::tell_estimate(const imc::SimulatedState& s) {
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
  // over ground: R_nb of Euler angles ZYX times the velocity through the water, and the current
  const float across = std::cos(s.phi) * s.v - std::sin(s.phi) * s.w;
  const float lifted = std::sin(s.phi) * s.v + std::cos(s.phi) * s.w;
  const float along = std::cos(s.theta) * s.u + std::sin(s.theta) * lifted;
  e.vx = std::cos(s.psi) * along - std::sin(s.psi) * across + s.svx;
  e.vy = std::sin(s.psi) * along + std::cos(s.psi) * across + s.svy;
  e.vz = std::cos(s.theta) * lifted - std::sin(s.theta) * s.u + s.svz;
  e.p = s.p;
  e.q = s.q;
  e.r = s.r;
  e.alt = -1;
  to_.receive(messages::refer_to(e));
}

void SubmarineTelemetry::tell_water(const imc::SimulatedState& s) {
  using Validity = imc::GroundVelocity::Validity;
  const auto [x, y, z] = to_body(s, s.svx, s.svy, s.svz);
  to_.receive(messages::refer_to(imc::GroundVelocity{Validity::VAL_VEL_X | Validity::VAL_VEL_Y | Validity::VAL_VEL_Z,
                                                     static_cast<double>(s.u) + x, static_cast<double>(s.v) + y,
                                                     static_cast<double>(s.w) + z}));
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
                                                     .longitude = truth.at.lon + truth.at.y / radii.east,
                                                     .address = address});
  return messages::Message(messages::refer_to(announce));
}

}  // namespace jarol::vehicles
