#include "vehicles/submarine/vsim_plant.h"

#include <algorithm>
#include <cmath>

#include "distributers/interfaces/no_state.h"
#include "graph/math/geometry.h"
#include "graph/math/rotations.h"
#include "graph/text/errors.h"
#include "vehicles/submarine/coefficients.h"

namespace jarol::vehicles {
namespace {

using fossen::Vector6;

void add(Vector6& sum, const Vector6& term) {
  for (std::size_t i = 0; i < 6; ++i) sum[i] += term[i];
}

// fins give no roll, and lift by the whole speed through the water; out of the water nothing pushes up or down
Vector6 actuator_force(const SubmarineBody& body, const SubmarineInput& input, double speed, double z) {
  double side = 0.0, down = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double lift = body.fin_lift * limited(input.fins[i], body.fin_stall) * speed * speed;
    (i % 3 == 0 ? side : down) += i % 3 == 0 ? lift : -lift;
  }
  const double x = body.fins[0].r_b[0];
  return {calc_thrust(body.propeller, input.propeller, speed), side, z <= 0.0 ? 0.0 : down, 0.0, -x * down, x * side};
}

// an upright box as high as the hull; no force along the hull
Vector6 restoring_force(const FloatingHull& hull, const PlantState& s) {
  const double height = 2.0 * hull.semi_axes[2];
  const double B = hull.B * std::clamp(s.eta[2] + 0.5 * height, 0.0, height) / height;
  const double across = std::cos(s.eta[4]) * std::sin(s.eta[3]), along = std::cos(s.eta[4]) * std::cos(s.eta[3]);
  const double arm = hull.r_bg[2] * hull.W;
  return {0.0, (hull.W - B) * across, (hull.W - B) * along, -arm * across, -arm * std::sin(s.eta[4]), 0.0};
}

Vector6 coriolis_force(const SubmarineBody& body, const VsimParameters& vsim, const Vector6& nu) {
  const auto [u, v, w, p, q, r] = nu;
  const double m = body.M_rb[0][0], z_g = body.hull.r_bg[2];
  const double m_u = m + body.M_a[0][0], m_v = m + body.M_a[1][1], m_w = m + body.M_a[2][2];
  const double J_1 = vsim.M_u, J_2 = vsim.M_v, J_3 = vsim.M_w;  // the error: they should be I_p, I_q, I_r
  return {-m * z_g * r * p - m_w * w * q + m_v * v * r,
          m_w * w * p - m * z_g * r * q - m_u * u * r,
          m * z_g * (p * p + q * q) - m_v * v * p + m_u * u * q,
          m * z_g * r * u - m_w * w * v - (m * z_g * p - m_v * v) * w - J_3 * r * q + J_2 * q * r,
          m_w * w * u + m * z_g * r * v - (m * z_g * q + m_u * u) * w + J_3 * r * p - J_1 * p * r,
          -m_v * v * u + m_u * u * v - J_2 * q * p + J_1 * p * q};
}

// lift by the speed ahead with its sign: astern it drives what it should damp
Vector6 drag_force(const fossen::Damping& D, const Vector6& nu) {
  Vector6 force{};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      force[i] += (D.linear[i][j] + D.lift[i][j] * nu[0] + D.quadratic[i][j] * std::abs(nu[j])) * nu[j];
    }
  }
  return force;
}

// rates of NED offset and of Euler angles
Vector6 calc_eta_dot(const PlantState& s) {
  const double phi = s.eta[3], theta = s.eta[4], psi = s.eta[5];
  const Eigen::Vector3d v_n = rotation_of(phi, theta, psi) * Eigen::Vector3d(s.nu[0], s.nu[1], s.nu[2]);
  const Eigen::Vector3d angle_rates = euler_rates(phi, theta, {s.nu[3], s.nu[4], s.nu[5]});
  return {v_n.x(), v_n.y(), v_n.z(), angle_rates.x(), angle_rates.y(), angle_rates.z()};
}

}  // namespace

VsimPlant::VsimPlant(const SubmarineParameters& parameters, const PlantState& start)
    : body_(make_body(parameters)), vsim_(parameters.vsim), state_(start) {
  for (const double each : {vsim_.M_u, vsim_.M_v, vsim_.M_w, vsim_.I_p, vsim_.I_q, vsim_.I_r})
    if (!(each > 0.0)) throw InputError("submarine: each number of vsim must be above zero");
  if (parameters.dynamics == Dynamics::rigid)
    throw InputError("submarine: with vsim_compatible it has dynamics of its own; leave dynamics out");
  if (parameters.sea.wave_height != 0.0)
    throw InputError("submarine: with vsim_compatible there are no waves; sea.wave_height has to be 0");
}

Vector6 VsimPlant::calc_forces(const SubmarineInput& input) const {
  const Vector6& nu = state_.nu;
  const double speed = std::sqrt(nu[0] * nu[0] + nu[1] * nu[1] + nu[2] * nu[2]);
  Vector6 sum = actuator_force(body_, input, speed, state_.eta[2]);
  add(sum, restoring_force(body_.hull, state_));
  add(sum, coriolis_force(body_, vsim_, nu));
  add(sum, drag_force(body_.D, nu));
  return sum;
}

void VsimPlant::serialize(Archive& archive) { archive(state_, steps_); }

void VsimPlant::step(const SubmarineInput& input) {
  // place and velocity from the same old state; the sea's surface is a lid
  const Vector6 force = calc_forces(input), eta_dot = calc_eta_dot(state_);
  const double inertia[] = {vsim_.M_u, vsim_.M_v, vsim_.M_w, vsim_.I_p, vsim_.I_q, vsim_.I_r};
  double sum = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    state_.nu_dot[i] = force[i] / inertia[i];
    state_.nu[i] += step_seconds * state_.nu_dot[i];
    state_.eta[i] += step_seconds * eta_dot[i];
    sum += std::abs(state_.nu[i]) + std::abs(state_.eta[i]);
  }
  state_.eta[2] = std::max(0.0, state_.eta[2]);
  state_.eta[3] = wrapped(state_.eta[3]);
  state_.eta[5] = wrapped(state_.eta[5]);
  ++steps_;
  if (!std::isfinite(sum))
    throw NoState("submarine: no state at t = " + std::to_string(static_cast<double>(steps_) * step_seconds) +
                  " s: a number in it is not finite");
}

}  // namespace jarol::vehicles
