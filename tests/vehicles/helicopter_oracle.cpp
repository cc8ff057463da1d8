#include "tests/vehicles/helicopter_oracle.h"

#include <cmath>

namespace jarol::test {
namespace {
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double quarter = 1.5707963267948966;

// Bearing of rotor i from the nose, clockwise: front, right, rear, left.
Vector3d hub(const vehicles::RotorParameters& rotors, int i) {
  return {rotors.arm * std::cos(i * quarter), rotors.arm * std::sin(i * quarter), -rotors.height};
}

double clockwise(int i) { return i == 0 || i == 2 ? 1.0 : -1.0; }
}  // namespace

HelicopterOracle::HelicopterOracle(const vehicles::HelicopterParameters& parameters, double height,
                                   const std::array<double, 4>& settings)
    : parameters_(parameters) {
  state_.setZero();
  state_[2] = -height;
  state_[6] = 1.0;
  for (int i = 0; i < 4; ++i) state_[13 + i] = settings[static_cast<std::size_t>(i)];
  state_.segment<3>(10) = calc_spin(state_);
}

Eigen::Matrix3d HelicopterOracle::rotation() const {
  return Quaterniond(Eigen::Vector4d(state_.segment<4>(3))).toRotationMatrix();
}

// of the rotors relative to the hull, in body axes; rotor speed goes with the root of thrust
Vector3d HelicopterOracle::calc_spin(const State& state) const {
  const auto& r = parameters_.rotors;
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
    sum += clockwise(i) * r.inertia * r.full_speed * std::pow(state[13 + i], r.thrust_exponent / 2);
  return {0, 0, sum};
}

Vector3d HelicopterOracle::rates() const {
  const auto& f = parameters_.frame;
  const Quaterniond q(Eigen::Vector4d(state_.segment<4>(3)));
  const Vector3d L = q.conjugate() * Vector3d(state_.segment<3>(10)) - calc_spin(state_);
  return {L.x() / f.I_x, L.y() / f.I_y, L.z() / f.I_z};
}

HelicopterOracle::State HelicopterOracle::calc_rate(const State& state, const Vector4d& settings,
                                                    const Vector3d& wind) const {
  const auto& f = parameters_.frame;
  const auto& r = parameters_.rotors;
  Quaterniond q(Eigen::Vector4d(state.segment<4>(3)));
  q.normalize();
  const Vector3d velocity = state.segment<3>(7) / f.mass;
  const Vector3d L = q.conjugate() * Vector3d(state.segment<3>(10)) - calc_spin(state);
  const Vector3d omega(L.x() / f.I_x, L.y() / f.I_y, L.z() / f.I_z);
  const Vector3d air = velocity - wind;

  // all in NED
  Vector3d force = f.mass * parameters_.air.gravity * Vector3d::UnitZ() -
                   0.5 * parameters_.air.density * f.drag_area * air.norm() * air;
  Vector3d moment = Vector3d::Zero();
  const Vector3d axis = q * Vector3d::UnitZ();
  for (int i = 0; i < 4; ++i) {
    const Vector3d at = q * hub(r, i);
    const double height = -(state[2] + at.z());
    const double free = r.full_thrust * std::pow(state[13 + i], r.thrust_exponent);
    const double thrust = free * (1 + r.ground_effect * (1 / (1 - std::pow(r.radius / (4 * height), 2)) - 1));
    const double speed = r.full_speed * std::pow(state[13 + i], r.thrust_exponent / 2);
    const Vector3d flow = air + (q * omega).cross(at);
    const Vector3d along = flow.dot(axis) * axis;
    const Vector3d on_hub = -thrust * axis - speed * (r.inflow * along + r.drag * (flow - along));
    force += on_hub;
    moment += at.cross(on_hub) - clockwise(i) * r.torque_per_thrust * thrust * axis;
  }

  State rate;
  rate.segment<3>(0) = velocity;
  const Quaterniond spin(0.0, omega.x(), omega.y(), omega.z());
  rate.segment<4>(3) = 0.5 * (q * spin).coeffs();
  rate.segment<3>(7) = force;
  rate.segment<3>(10) = moment;
  rate.segment<4>(13) = (settings - state.segment<4>(13)) / r.lag;
  return rate;
}

void HelicopterOracle::advance(double seconds, const std::array<double, 4>& settings, const Vector3d& wind) {
  const Vector4d to(settings[0], settings[1], settings[2], settings[3]);
  const int count = static_cast<int>(std::ceil(seconds / 5e-4 - 1e-6));
  const double h = seconds / count;
  for (int i = 0; i < count; ++i) {
    const State k1 = calc_rate(state_, to, wind);
    const State k2 = calc_rate(state_ + 0.5 * h * k1, to, wind);
    const State k3 = calc_rate(state_ + 0.5 * h * k2, to, wind);
    const State k4 = calc_rate(state_ + h * k3, to, wind);
    state_ += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    state_.segment<4>(3).normalize();
  }
}

}  // namespace jarol::test
