// Euler angles ZYX (roll phi, pitch theta, yaw psi, in rad) of body axes (forward, right, down) in NED, without Eigen.
#pragma once

#include <array>
#include <cmath>

#include "graph/math/geometry.h"

namespace jarol {

struct EulerAngles {
  double roll = 0, pitch = 0, yaw = 0;
};

/// Of R_nb, which turns vectors of body axes into NED, as rows: `R_nb[2][0]` is -sin(theta).
template <typename Rows>
EulerAngles euler_angles_of(const Rows& R_nb) {
  return {std::atan2(R_nb[2][1], R_nb[2][2]), -std::asin(limited(R_nb[2][0], 1.0)), std::atan2(R_nb[1][0], R_nb[0][0])};
}

/// The unit vector down in body axes, the third row of R_nb.
inline std::array<double, 3> down_in_body(double roll, double pitch) {
  return {-std::sin(pitch), std::cos(pitch) * std::sin(roll), std::cos(pitch) * std::cos(roll)};
}

/// How deep a length along the body's z axis reaches, as that of an altimeter's beam.
inline double vertical_part(double along_z, double roll, double pitch) {
  return along_z * std::cos(pitch) * std::cos(roll);
}

/// z_dot (m/s, positive down) by velocity across the hull, v to the right and w down in body axes.
inline double sinking_across(double roll, double pitch, double v, double w) {
  return (v * std::sin(roll) + w * std::cos(roll)) * std::cos(pitch);
}

/// z_dot of all of it, u forward: the third row of R_nb times the velocity in body axes.
inline double sinking(double roll, double pitch, double u, double v, double w) {
  return -u * std::sin(pitch) + sinking_across(roll, pitch, v, w);
}

}  // namespace jarol
