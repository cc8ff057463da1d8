#include "vehicles/sea/hydrostatics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace jarol::vehicles {

using fossen::Vector3;
using fossen::Vector6;

double immersed_part(double height) {
  const double s = std::clamp(0.5 * (height + 1.0), 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

Immersed calc_immersed(const FloatingHull& hull, const Immersion& at) {
  // the affine map that makes the ellipsoid a unit sphere takes planes to planes and keeps ratios of volumes
  Vector3 normal;
  for (std::size_t i = 0; i < 3; ++i) normal[i] = hull.semi_axes[i] * at.down_b[i];
  const double reach = std::sqrt(fossen::dot(normal, normal));
  const double height = at.z / reach;
  if (height >= 1.0) return {1.0, {}};
  if (height <= -1.0) return {};

  // moment of the cap's volume: int t pi (1 - t^2) dt from -height to 1, over the sphere's 4 pi / 3
  const double part = immersed_part(height);
  const double rest = 1.0 - height * height;
  const double moment = 3.0 / 16.0 * rest * rest;
  Immersed immersed{part, {}};
  if (part > 0.0) {
    for (std::size_t i = 0; i < 3; ++i) immersed.centre_b[i] = hull.semi_axes[i] * normal[i] / reach * (moment / part);
  }
  return immersed;
}

Vector6 restoring_force(const FloatingHull& hull, const Immersed& immersed, const Immersion& at) {
  const double B = hull.B * immersed.part;
  Vector3 arm;
  for (std::size_t i = 0; i < 3; ++i) arm[i] = hull.r_bg[i] * hull.W - immersed.centre_b[i] * B;
  const Vector3 moment = fossen::cross(arm, at.down_b);
  const double down = hull.W - B;
  return {down * at.down_b[0], down * at.down_b[1], down * at.down_b[2], moment[0], moment[1], moment[2]};
}

double calc_floating_depth(const FloatingHull& hull) {
  const double reach = hull.semi_axes[2];
  if (hull.W >= hull.B) return reach;

  // bisection to the last bit: the immersed part grows with depth
  double above = -1.0;
  double below = 1.0;
  for (double middle = 0.0; above < middle && middle < below; middle = 0.5 * (above + below)) {
    (immersed_part(middle) * hull.B < hull.W ? above : below) = middle;
  }
  return reach * below;
}

}  // namespace jarol::vehicles
