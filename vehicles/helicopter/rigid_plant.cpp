#include "vehicles/helicopter/rigid_plant.h"

namespace jarol::vehicles {
namespace {

HelicopterMotion motion_of(const RigidState& s, const Eigen::Matrix3d& R_nb) {
  HelicopterMotion motion;
  motion.p_n = plain(s.p_n);
  for (std::size_t i = 0; i < 3; ++i) motion.R_nb[i] = plain(R_nb.row(static_cast<Eigen::Index>(i)).transpose());
  motion.v_b = plain(R_nb.transpose() * s.v_n);
  motion.omega_b = plain(R_nb.transpose() * s.omega_n);
  return motion;
}

}  // namespace

RigidHelicopter::RigidHelicopter(const HelicopterBody& body, const HelicopterMotion& start,
                                 const std::array<double, 4>& settings)
    : HelicopterDynamics(body, start, settings) {
  Eigen::Matrix3d R_nb;
  for (std::size_t i = 0; i < 3; ++i) R_nb.row(static_cast<Eigen::Index>(i)) = Eigen::RowVector3d(start.R_nb[i].data());
  state_.p_n = Eigen::Vector3d(start.p_n.data());
  state_.q_nb = Eigen::Quaterniond(R_nb);
  state_.v_n = R_nb * Eigen::Vector3d(start.v_b.data());
  state_.omega_n = R_nb * Eigen::Vector3d(start.omega_b.data());
}

// m (v_dot - g) = R F, I omega_dot + omega x I omega = M
HelicopterMotion RigidHelicopter::advance(const HelicopterInput& input, double from, double to) {
  const Eigen::Vector3d I(body().inertia.data());
  state_ = kutta_step(state_, from, to - from, [&](const RigidState& at, double time) {
    const Eigen::Matrix3d R_nb = at.R_nb();
    const HelicopterMotion motion = motion_of(at, R_nb);
    const fossen::Vector6 loads = calc_loads(body(), motion, input, time);
    const Eigen::Vector3d force(loads.data()), moment(loads.data() + 3), omega_b(motion.omega_b.data());
    Eigen::Vector3d v_dot_n = R_nb * force / body().mass;
    v_dot_n.z() += body().gravity;
    return rates_of(at, R_nb, v_dot_n, (moment - omega_b.cross(I.cwiseProduct(omega_b))).cwiseQuotient(I));
  });
  return motion_of(state_, state_.R_nb());
}

}  // namespace jarol::vehicles
