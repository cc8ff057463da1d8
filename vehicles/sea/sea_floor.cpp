#include "vehicles/sea/sea_floor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace jarol::vehicles {
namespace {

// sand: soft enough for steps of 10 ms
constexpr double stiffness = 5000.0, damping = 300.0, friction = 0.3;
constexpr double sliding_speed = 0.02;  // m/s, below which friction fades

}  // namespace

fossen::Vector6 floor_force(const SeaFloor& floor, const Immersion& at, const fossen::Vector6& nu) {
  using fossen::Vector3;
  fossen::Vector6 sum{};
  for (const double end : {1.0, -1.0}) {
    Vector3 r_b = {end * (floor.half_length - floor.radius), 0.0, 0.0};
    for (std::size_t i = 0; i < 3; ++i) r_b[i] += floor.radius * at.down_b[i];
    const double deep = at.z + fossen::dot(at.down_b, r_b) - floor.depth;
    if (deep <= 0.0) continue;

    Vector3 v_b = fossen::cross({nu[3], nu[4], nu[5]}, r_b);
    for (std::size_t i = 0; i < 3; ++i) v_b[i] += nu[i];
    const double sinking = fossen::dot(v_b, at.down_b);
    // the damper works no sooner than the spring: no blow at touch-down
    const double normal = std::max(0.0, stiffness * deep + damping * std::min(1.0, deep / 0.01) * sinking);
    Vector3 slide_b;
    for (std::size_t i = 0; i < 3; ++i) slide_b[i] = v_b[i] - sinking * at.down_b[i];
    const double slide = std::sqrt(fossen::dot(slide_b, slide_b) + sliding_speed * sliding_speed);
    Vector3 force;
    for (std::size_t i = 0; i < 3; ++i) force[i] = -normal * (at.down_b[i] + friction * slide_b[i] / slide);
    const Vector3 moment = fossen::cross(r_b, force);
    for (std::size_t i = 0; i < 3; ++i) {
      sum[i] += force[i];
      sum[i + 3] += moment[i];
    }
  }
  return sum;
}

}  // namespace jarol::vehicles
