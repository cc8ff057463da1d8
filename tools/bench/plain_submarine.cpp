#include "tools/bench/plain_submarine.h"

namespace jarol::bench {
namespace {

using Eigen::Vector3d;

Eigen::Matrix<double, 6, 6> matrix(const vehicles::fossen::Matrix6& from) {
  Eigen::Matrix<double, 6, 6> to;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) to(i, j) = from[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return to;
}

}  // namespace

PlainSubmarine::PlainSubmarine(const vehicles::SubmarineParameters& parameters)
    : body_(vehicles::make_body(parameters)) {
  M_ = matrix(body_.M_rb) + matrix(body_.M_a);
  M_inverse_ = M_.inverse();
  linear_ = matrix(body_.D.linear);
  lift_ = matrix(body_.D.lift);
  quadratic_ = matrix(body_.D.quadratic);
  state_.setZero();
  state_[2] = 3.0;
  state_[6] = 1.0;
  state_[7] = 1.0;
}

PlainSubmarine::State PlainSubmarine::calc_rate(const State& state, double propeller) const {
  const Eigen::Quaterniond q(state[6], state[3], state[4], state[5]);
  const Vector6 nu = state.tail<6>();
  const Vector3d v = nu.head<3>(), omega = nu.tail<3>(), down = q.conjugate() * Vector3d::UnitZ();

  Vector6 tau = linear_ * nu + std::abs(nu[0]) * (lift_ * nu) + quadratic_ * nu.cwiseAbs().cwiseProduct(nu);
  const Vector6 momentum = M_ * nu;
  const Vector3d p = momentum.head<3>(), h = momentum.tail<3>();
  tau.head<3>() -= omega.cross(p);
  tau.tail<3>() -= omega.cross(h) + v.cross(p);
  const Vector3d r_bg(body_.hull.r_bg[0], body_.hull.r_bg[1], body_.hull.r_bg[2]);
  tau.head<3>() += (body_.hull.W - body_.hull.B) * down;
  tau.tail<3>() += r_bg.cross(body_.hull.W * down);
  tau[0] += vehicles::calc_thrust(body_.propeller, propeller, nu[0]);

  State rate;
  rate.head<3>() = q * v;
  rate.segment<4>(3) = 0.5 * (q * Eigen::Quaterniond(0.0, omega.x(), omega.y(), omega.z())).coeffs();
  rate.tail<6>() = M_inverse_ * tau;
  return rate;
}

void PlainSubmarine::step(double seconds, double propeller) {
  const State k1 = calc_rate(state_, propeller), k2 = calc_rate(state_ + 0.5 * seconds * k1, propeller),
              k3 = calc_rate(state_ + 0.5 * seconds * k2, propeller), k4 = calc_rate(state_ + seconds * k3, propeller);
  state_ += seconds / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  state_.segment<4>(3).normalize();
}

}  // namespace jarol::bench
