#include "vehicles/submarine/rigid_plant.h"

#include <cmath>
#include <string>

#include "distributers/interfaces/no_state.h"

namespace jarol::vehicles {
namespace {

fossen::Vector6 plain(const Vector6d& x) { return {x[0], x[1], x[2], x[3], x[4], x[5]}; }

}  // namespace

RigidSubmarine::RigidSubmarine(const SubmarineBody& body, const Waves& waves, const PlantState& start)
    : body_(body), waves_(waves) {
  state_.p_n = {start.eta[0], start.eta[1], start.eta[2]};
  state_.q_nb = quaternion_of(start.eta[3], start.eta[4], start.eta[5]);
  const Eigen::Matrix3d R_nb = state_.R_nb();
  state_.v_n = R_nb * Eigen::Vector3d(start.nu[0], start.nu[1], start.nu[2]);
  state_.omega_n = R_nb * Eigen::Vector3d(start.nu[3], start.nu[4], start.nu[5]);
}

fossen::Vector6 RigidSubmarine::acceleration(const Eigen::Vector3d& p_n, const Vector6d& nu,
                                             const Eigen::Matrix3d& R_nb, double seconds) const {
  const fossen::Vector3 down_b{R_nb(2, 0), R_nb(2, 1), R_nb(2, 2)};
  Surroundings around{{p_n[2], down_b}, p_n[2]};
  if (!waves_.still()) {
    const Water water = waves_.at(plain(p_n), seconds);
    const auto in_body = [&](const fossen::Vector3& v_n) {
      return plain(Eigen::Vector3d(R_nb.transpose() * Eigen::Vector3d(v_n[0], v_n[1], v_n[2])));
    };
    around.at.z -= water.surface;
    around.velocity_b = in_body(water.velocity_n);
    around.acceleration_b = in_body(water.acceleration_n);
  }
  return calc_nu_dot(body_, around, plain(nu), input_);
}

void RigidSubmarine::step(const SubmarineInput& input) {
  input_ = input;
  const double t = static_cast<double>(steps_) * step_seconds;
  state_ = merson_step(state_, t, step_seconds,
                       [&](const Eigen::Vector3d& p_n, const Vector6d& nu, const Eigen::Matrix3d& R_nb, double time) {
                         return Vector6d(acceleration(p_n, nu, R_nb, time).data());
                       });
  ++steps_;
  if (!std::isfinite(state_.p_n.sum() + state_.q_nb.coeffs().sum() + state_.v_n.sum() + state_.omega_n.sum()))
    throw NoState("submarine: no state at t = " + std::to_string(static_cast<double>(steps_) * step_seconds) +
                  " s: a number in it is not finite");
}

PlantState RigidSubmarine::state() const {
  const Eigen::Matrix3d R_nb = state_.R_nb();
  PlantState out;
  for (std::size_t i = 0; i < 3; ++i) out.eta[i] = state_.p_n[static_cast<Eigen::Index>(i)];
  const EulerAngles attitude = euler_angles_of(R_nb);
  out.eta[3] = attitude.roll;
  out.eta[4] = attitude.pitch;
  out.eta[5] = attitude.yaw;
  const Vector6d nu = nu_of(state_, R_nb);
  out.nu = plain(nu);
  out.nu_dot = acceleration(state_.p_n, nu, R_nb, static_cast<double>(steps_) * step_seconds);
  return out;
}

}  // namespace jarol::vehicles
