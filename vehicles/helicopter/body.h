// The helicopter as a rigid body in air and on its feet: four rotors, their aerodynamics and angular momentum, the
// ground. Body axes b are forward, right, down with the centre of gravity as origin; the ground is z = 0 of NED. Plain
// C++17.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "vehicles/helicopter/feet.h"
#include "vehicles/helicopter/thrust_law.h"

namespace jarol::vehicles {

/// What the plant moves and the loads depend on.
struct HelicopterMotion {
  fossen::Vector3 p_n{};  // centre of gravity, NED
  std::array<fossen::Vector3, 3> R_nb{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  fossen::Vector3 v_b{};
  fossen::Vector3 omega_b{};

  void serialize(Archive& archive) { archive(p_n, R_nb, v_b, omega_b); }
};

/// Rotors in the order front, right, rear, left.
struct HelicopterBody {
  double mass = 1.0;
  double payload = 0.0;  // kg more in the centre of gravity, at the start
  double gravity = 9.81;
  fossen::Vector3 inertia{1.0, 1.0, 1.0};  // principal moments about the centre of gravity

  struct Rotor {
    fossen::Vector3 hub_b{};
    double spin = 1.0;  // 1 clockwise seen from above, which is positive about z, or -1
  };
  std::array<Rotor, 4> rotors{};
  double full_thrust = 1.0;
  ThrustLaw thrust_law{};  // knows the settings that the rotors had last
  double lag = 0.05;
  double torque_per_thrust = 0.0;
  double rotor_inertia = 0.0;
  double full_speed = 0.0;
  double rotor_drag = 0.0;
  double rotor_inflow = 0.0;
  double rotor_radius = 0.25;
  double ground_effect = 0.0;
  double drag = 0.0;  // 1/2 rho times the drag area

  Feet feet{};
};

/// Constant over a step but for the rotors' settings, which move from their state at its begin towards those commanded.
struct HelicopterInput {
  std::array<double, 4> from{};  // setting: 0 to 1 at the reference voltage
  std::array<double, 4> to{};
  double begin = 0.0;  // s
  fossen::Vector3 wind_n{};
  std::array<FootAnchor, contact_count> anchors{};
  double payload = 0.0;

  void serialize(Archive& archive) { archive(from, to, begin, wind_n, anchors, payload); }
};

/// The part of a change of setting that is still to come after a time: first-order lag, solved exactly.
inline double calc_remaining(const HelicopterBody& body, double seconds) {
  return seconds == 0.0 ? 1.0 : std::exp(-seconds / body.lag);
}

/// Force and moment about the centre of gravity in body axes, weight left out. The force is what moves the body, of
/// which a payload takes its share.
fossen::Vector6 calc_loads(const HelicopterBody& body, const HelicopterMotion& motion, const HelicopterInput& input,
                           double time);

/// In NED axes.
inline fossen::Vector3 to_ned(const std::array<fossen::Vector3, 3>& R_nb, const fossen::Vector3& b) {
  return {fossen::dot(R_nb[0], b), fossen::dot(R_nb[1], b), fossen::dot(R_nb[2], b)};
}
/// In body axes.
inline fossen::Vector3 from_ned(const std::array<fossen::Vector3, 3>& R_nb, const fossen::Vector3& n) {
  fossen::Vector3 b{};
  for (std::size_t i = 0; i < 3; ++i) b[i] = n[0] * R_nb[0][i] + n[1] * R_nb[1][i] + n[2] * R_nb[2][i];
  return b;
}
/// Of a foot that stands there in the body.
FootMotion foot_motion(const HelicopterMotion& motion, const fossen::Vector3& r_b);
/// False: it is so high that no contact is within `margin` of the ground, however it leans; most of a flight is.
inline bool may_touch(const HelicopterBody& body, const HelicopterMotion& motion, double margin = 0.0) {
  // a rotation matrix is one but for rounding; a place that is no number may be anywhere
  return !(motion.p_n[2] < -1.001 * (body.feet.reach + margin));
}
/// Its z of NED.
inline double foot_depth(const HelicopterMotion& motion, const fossen::Vector3& r_b) {
  return motion.p_n[2] + fossen::dot(motion.R_nb[2], r_b);
}

}  // namespace jarol::vehicles
