#include "vehicles/helicopter/body.h"

#include <algorithm>
#include <cmath>

namespace jarol::vehicles {
namespace {

using fossen::Vector3;

Vector3 sum(const Vector3& a, const Vector3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Vector3 scaled(const Vector3& a, double factor) { return {factor * a[0], factor * a[1], factor * a[2]}; }

void add(Vector3& total, const Vector3& term) { total = sum(total, term); }

// Cheeseman and Bennett, "The Effect of the Ground on a Helicopter Rotor in Forward Flight", 1955: T/T_free =
// 1 / (1 - (R/4h)^2), no nearer than half a radius
double ground_gain(const HelicopterBody& body, double height) {
  const double ratio = body.rotor_radius / (4.0 * std::max(height, 0.5 * body.rotor_radius));
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

  double spin = 0.0;      // angular momentum of the rotors along z
  double spin_dot = 0.0;  // and its rate
  for (std::size_t i = 0; i < body.rotors.size(); ++i) {
    const HelicopterBody::Rotor& rotor = body.rotors[i];
    const double change = (input.from[i] - input.to[i]) * remaining;
    const double setting = input.to[i] + change;
    const double height = -(motion.p_n[2] + fossen::dot(down_b, rotor.hub_b));
    const double free_thrust = calc_thrust(body, i, setting);
    const double thrust = free_thrust * ground_gain(body, height);

    // thrust grows with speed squared; its power law has no slope at rest, where nothing turns anyway
    const double speed = body.full_speed * std::sqrt(free_thrust / body.full_thrust);
    spin += rotor.spin * body.rotor_inertia * speed;
    spin_dot -= rotor.spin * body.rotor_inertia * speed * 0.5 * body.thrust_law[i].exponent() /
                std::max(setting, 0.02) * change / body.lag;

    // blades resist flow in their plane and along their axis in proportion to their speed
    const Vector3 flow = sum(air_b, fossen::cross(motion.omega_b, rotor.hub_b));
    const Vector3 hub = {-body.rotor_drag * speed * flow[0], -body.rotor_drag * speed * flow[1],
                         -thrust - body.rotor_inflow * speed * flow[2]};
    add(force, hub);
    add(moment, fossen::cross(rotor.hub_b, hub));
    moment[2] -= rotor.spin * body.torque_per_thrust * thrust;
  }
  add(moment, scaled(fossen::cross(motion.omega_b, {0.0, 0.0, spin}), -1.0));
  moment[2] -= spin_dot;

  add(force, scaled(air_b, -body.drag * std::sqrt(fossen::dot(air_b, air_b))));

  for (std::size_t i = 0; i < body.feet.r_b.size(); ++i) {
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
