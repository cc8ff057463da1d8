#include "distributers/lauv/messages.h"

#include <chrono>
#include <cmath>

namespace jarol::distributers {
namespace imc = messages::imc;

std::string_view name_of(tasks::Alarm alarm) {
  for (const auto& e : enumerators(alarm))
    if (e.value == alarm) return e.name;
  return "";
}

double unix_time() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

imc::EstimatedState estimate_state(const tasks::Motion& m, double latitude, double longitude) {
  imc::EstimatedState s;
  s.lat = latitude;
  s.lon = longitude;
  s.x = static_cast<float>(m.x);
  s.y = static_cast<float>(m.y);
  s.z = static_cast<float>(m.z);
  s.phi = static_cast<float>(m.phi);
  s.theta = static_cast<float>(m.theta);
  s.psi = static_cast<float>(m.psi);
  s.u = static_cast<float>(m.u);
  s.v = static_cast<float>(m.v);
  s.w = static_cast<float>(m.w);
  // R_nb of Euler angles ZYX times the velocity
  const double c_phi = std::cos(m.phi), s_phi = std::sin(m.phi), c_theta = std::cos(m.theta),
               s_theta = std::sin(m.theta), c_psi = std::cos(m.psi), s_psi = std::sin(m.psi);
  const double across = c_phi * m.v - s_phi * m.w, lifted = s_phi * m.v + c_phi * m.w;
  const double along = c_theta * m.u + s_theta * lifted;
  s.vx = static_cast<float>(c_psi * along - s_psi * across);
  s.vy = static_cast<float>(s_psi * along + c_psi * across);
  s.vz = static_cast<float>(c_theta * lifted - s_theta * m.u);
  s.p = static_cast<float>(m.p);
  s.q = static_cast<float>(m.q);
  s.r = static_cast<float>(m.r);
  s.depth = static_cast<float>(m.z);
  s.alt = -1;
  return s;
}

}  // namespace jarol::distributers
