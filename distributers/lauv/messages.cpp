#include "distributers/lauv/messages.h"

#include <chrono>

#include "graph/math/rotations.h"

namespace jarol::distributers {
namespace imc = messages::imc;

std::string_view name_of(tasks::Alarm alarm) {
  for (const auto& e : enumerators(alarm))
    if (e.value == alarm) return e.name;
  return "";
}

std::string_view meaning_of(tasks::FinCheck fins) {
  for (const auto& e : enumerators(fins))
    if (e.value == fins) return e.meaning;
  return "";
}

double unix_time() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

imc::EstimatedState estimate_state(const tasks::Motion& m, const tasks::Stream& stream, double latitude,
                                   double longitude, double altitude) {
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
  const Eigen::Vector3d through_water = rotation_of(m.phi, m.theta, m.psi) * Eigen::Vector3d(m.u, m.v, m.w);
  const Eigen::Vector3f v_n = (through_water + Eigen::Vector3d(stream.north, stream.east, 0)).cast<float>();
  s.vx = v_n.x();
  s.vy = v_n.y();
  s.vz = v_n.z();
  s.p = static_cast<float>(m.p);
  s.q = static_cast<float>(m.q);
  s.r = static_cast<float>(m.r);
  s.depth = static_cast<float>(m.z);
  s.alt = static_cast<float>(altitude);
  return s;
}

}  // namespace jarol::distributers
