#include "vehicles/helicopter/body.h"

#include <Eigen/Core>
#include <cmath>

namespace jarol::vehicles {
namespace {

using fossen::Vector3;

Vector3 sum(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Vector3 scaled(const Vector3& a, double factor) { return {factor * a[0], factor * a[1], factor * a[2]}; }

void add(Vector3& total, const Vector3& term) { total = sum(total, term); }

// One number for each rotor: all four are computed at once, two to an instruction.
using Rotors = Eigen::Array4d;
using RotorVectors = std::array<Rotors, 3>;

Rotors of_each(const std::array<double, 4>& numbers) { return Rotors(numbers.data()); }

// a x b of one vector and four, and of four and four
RotorVectors cross(const Vector3& a, const RotorVectors& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
RotorVectors cross(const RotorVectors& a, const RotorVectors& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Cheeseman and Bennett, "The Effect of the Ground on a Helicopter Rotor in Forward Flight", 1955: T/T_free =
// 1 / (1 - (R/4h)^2), no nearer than half a radius
Rotors ground_gain(const HelicopterBody& body, const Rotors& height) {
  const Rotors ratio = body.rotor_radius / (4.0 * height.max(0.5 * body.rotor_radius));
  return 1.0 + body.ground_effect * (1.0 / (1.0 - ratio * ratio) - 1.0);
}

}  // namespace

fossen::Vector6 calc_loads(const HelicopterBody& body, const HelicopterMotion& motion, const HelicopterInput& input,
                           double time) {
  const Vector3& down_b = motion.R_nb[2];
  const Vector3 air_b = sum(motion.v_b, scaled(from_ned(motion.R_nb, input.wind_n), -1.0));
  const double remaining = calc_remaining(body, time - input.begin);
  Vector3 force{};
  Vector3 moment{};

  RotorVectors hub_b;
  Rotors sense;
  const Rotors change = (of_each(input.from) - of_each(input.to)) * remaining;
  const Rotors setting = of_each(input.to) + change;
  // far from the ground and in air at rest
  const ThrustLaw& law = body.thrust_law;
  const Rotors free_thrust = body.full_thrust * of_each(law.parts({setting[0], setting[1], setting[2], setting[3]}));
  for (Eigen::Index i = 0; i < sense.size(); ++i) {
    const auto rotor = static_cast<std::size_t>(i);
    for (std::size_t axis = 0; axis < 3; ++axis) hub_b[axis][i] = body.rotors[rotor].hub_b[axis];
    sense[i] = body.rotors[rotor].spin;
  }
  const Rotors height = -(motion.p_n[2] + (down_b[0] * hub_b[0] + down_b[1] * hub_b[1] + down_b[2] * hub_b[2]));
  const Rotors thrust = free_thrust * ground_gain(body, height);

  // thrust grows with speed squared; its power law has no slope at rest, where nothing turns anyway
  const Rotors speed = body.full_speed * (free_thrust / body.full_thrust).sqrt();
  const Rotors spins = sense * body.rotor_inertia * speed;  // angular momenta along z, and their rates
  const Rotors spin_dots = -(spins * 0.5 * law.exponent() / setting.max(0.02) * change / body.lag);

  // blades resist flow in their plane and along their axis in proportion to their speed
  RotorVectors flow = cross(motion.omega_b, hub_b);
  for (std::size_t axis = 0; axis < 3; ++axis) flow[axis] = air_b[axis] + flow[axis];
  const RotorVectors hub = {-body.rotor_drag * speed * flow[0], -body.rotor_drag * speed * flow[1],
                            -thrust - body.rotor_inflow * speed * flow[2]};
  const RotorVectors turning = cross(hub_b, hub);
  const Rotors drag = sense * body.torque_per_thrust * thrust;
  double spin = 0.0, spin_dot = 0.0;
  for (Eigen::Index i = 0; i < sense.size(); ++i) {
    spin += spins[i];
    spin_dot += spin_dots[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      force[axis] += hub[axis][i];
      moment[axis] += turning[axis][i];
    }
    moment[2] -= drag[i];
  }
  add(moment, scaled(fossen::cross(motion.omega_b, {0.0, 0.0, spin}), -1.0));
  moment[2] -= spin_dot;

  add(force, scaled(air_b, -body.drag * std::sqrt(fossen::dot(air_b, air_b))));

  for (std::size_t i = 0; i < body.feet.r_b.size() && may_touch(body, motion); ++i) {
    const Vector3& r_b = body.feet.r_b[i];
    if (foot_depth(motion, r_b) <= 0.0) continue;
    const FootMotion foot = foot_motion(motion, r_b);
    const Vector3 on_foot = from_ned(motion.R_nb, calc_foot_force(body.feet, foot, input.anchors[i]));
    add(force, on_foot);
    add(moment, fossen::cross(r_b, on_foot));
  }
  const double share = body.mass / (body.mass + input.payload);
  return {share * force[0], share * force[1], share * force[2], moment[0], moment[1], moment[2]};
}

FootMotion foot_motion(const HelicopterMotion& motion, const Vector3& r_b) {
  return {sum(motion.p_n, to_ned(motion.R_nb, r_b)),
          to_ned(motion.R_nb, sum(motion.v_b, fossen::cross(motion.omega_b, r_b)))};
}

}  // namespace jarol::vehicles
