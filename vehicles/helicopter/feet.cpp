#include "vehicles/helicopter/feet.h"

#include <cmath>

namespace jarol::vehicles {
namespace {

// N = k d (1 + c d_dot) at depth d; below zero the ground would have to pull
double push(const Feet& feet, const FootMotion& foot) {
  const double depth = foot.p_n[2];
  if (depth <= 0.0) return 0.0;
  return feet.stiffness * depth * (1.0 + feet.dissipation * foot.v_n[2]);
}

}  // namespace

fossen::Vector3 calc_foot_force(const Feet& feet, const FootMotion& foot, const FootAnchor& anchor) {
  const double normal = push(feet, foot);
  if (normal <= 0.0) return {};
  const double x = -feet.grip_stiffness * (foot.p_n[0] - anchor.x) - feet.grip_damping * foot.v_n[0];
  const double y = -feet.grip_stiffness * (foot.p_n[1] - anchor.y) - feet.grip_damping * foot.v_n[1];
  const double wanted = std::hypot(x, y);
  const double limit = feet.friction * normal;
  const double part = wanted > limit ? limit / wanted : 1.0;
  return {part * x, part * y, -normal};
}

FootAnchor drag_along(const Feet& feet, const FootMotion& foot, const FootAnchor& anchor) {
  const FootAnchor here = {foot.p_n[0], foot.p_n[1]};
  const double normal = push(feet, foot);
  if (normal <= 0.0) return here;
  const double reach = feet.friction * normal / feet.grip_stiffness;
  const double away = std::hypot(here.x - anchor.x, here.y - anchor.y);
  if (away <= reach) return anchor;
  return {here.x + (anchor.x - here.x) * reach / away, here.y + (anchor.y - here.y) * reach / away};
}

}  // namespace jarol::vehicles
