#include "tools/bench/plain_helicopter.h"

#include <cmath>

namespace jarol::bench {
namespace {

using Eigen::Vector3d;

vehicles::fossen::Vector3 plain(const Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace

PlainHelicopter::PlainHelicopter(const vehicles::HelicopterParameters& parameters, double height)
    : body_(vehicles::make_body(parameters)) {
  const double part = body_.mass * body_.gravity / (4 * body_.full_thrust);
  input_.from.fill(std::pow(part, 1 / body_.thrust_law.exponent()));
  input_.to = input_.from;
  state_.setZero();
  state_[2] = -height;
  state_[6] = 1.0;
}

PlainHelicopter::State PlainHelicopter::calc_rate(const State& state, double time) const {
  const Eigen::Quaterniond q(state[6], state[3], state[4], state[5]);
  const Eigen::Matrix3d R = q.toRotationMatrix();
  const Vector3d v = state.segment<3>(7), omega = state.tail<3>();
  const vehicles::HelicopterMotion motion{
      plain(state.head<3>()),
      {{{R(0, 0), R(0, 1), R(0, 2)}, {R(1, 0), R(1, 1), R(1, 2)}, {R(2, 0), R(2, 1), R(2, 2)}}},
      plain(v),
      plain(omega)};
  const vehicles::fossen::Vector6 tau = calc_loads(body_, motion, input_, time);
  const Vector3d force(tau[0], tau[1], tau[2]), moment(tau[3], tau[4], tau[5]);
  const Vector3d I(body_.inertia[0], body_.inertia[1], body_.inertia[2]);
  State rate;
  rate.head<3>() = R * v;
  rate.segment<4>(3) = 0.5 * (q * Eigen::Quaterniond(0.0, omega.x(), omega.y(), omega.z())).coeffs();
  rate.segment<3>(7) = force / body_.mass + R.transpose() * Vector3d(0, 0, body_.gravity) - omega.cross(v);
  rate.tail<3>() = (moment - omega.cross(I.cwiseProduct(omega))).cwiseQuotient(I);
  return rate;
}

void PlainHelicopter::step(double seconds) {
  const double half = 0.5 * seconds;
  const State k1 = calc_rate(state_, 0), k2 = calc_rate(state_ + half * k1, half),
              k3 = calc_rate(state_ + half * k2, half), k4 = calc_rate(state_ + seconds * k3, seconds);
  state_ += seconds / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  state_.segment<4>(3).normalize();
}

}  // namespace jarol::bench
