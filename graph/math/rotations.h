// Attitudes as Euler angles ZYX (roll, pitch, yaw, in rad) of body axes (forward, right, down) in NED.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "graph/math/euler_angles.h"

namespace jarol {

/// Turns vectors of body axes into NED.
inline Eigen::Quaterniond quaternion_of(double roll, double pitch, double yaw) {
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
}

/// The same as a matrix, R_nb.
inline Eigen::Matrix3d rotation_of(double roll, double pitch, double yaw) {
  return quaternion_of(roll, pitch, yaw).toRotationMatrix();
}

inline EulerAngles euler_angles_of(const Eigen::Matrix3d& R_nb) {
  return euler_angles_of(std::array<Eigen::RowVector3d, 3>{R_nb.row(0), R_nb.row(1), R_nb.row(2)});
}

/// Beyond this pitch, where cos(pitch) is 0.1, laws that integrate the rates below take it for this one.
inline constexpr double max_pitch_of_rates = 1.4706289056333368;

/// Rates of roll, pitch and yaw (rad/s) under the rates p, q, r in body axes. Without bound at a pitch of 90 degrees.
/// Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2011, section 2.2.1.
inline Eigen::Vector3d euler_rates(double roll, double pitch, const Eigen::Vector3d& omega_b) {
  const double s = std::sin(roll), c = std::cos(roll);
  const double yaw_rate = (omega_b.y() * s + omega_b.z() * c) / std::cos(pitch);
  return {omega_b.x() + yaw_rate * std::sin(pitch), omega_b.y() * c - omega_b.z() * s, yaw_rate};
}

}  // namespace jarol
