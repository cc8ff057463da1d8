#include "vehicles/submarine_telemetry.h"

#include <cmath>

#include "vehicles/submarine_io.h"

namespace jarol::vehicles {
namespace imc = messages::imc;
namespace {
constexpr std::int64_t states_an_estimate = 5, states_a_heartbeat = 100;
}

void SubmarineTelemetry::receive(messages::MessageRef message) {
  to_.receive(message);
  const auto* truth = message.as<imc::SimulatedState>();
  if (truth == nullptr) return;
  tell_servos();
  if (states_ % states_an_estimate == 0) tell_estimate(*truth);
  if (states_ % states_a_heartbeat == 0) to_.receive(messages::refer_to(imc::Heartbeat{}));
  ++states_;
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

}  // namespace jarol::vehicles
