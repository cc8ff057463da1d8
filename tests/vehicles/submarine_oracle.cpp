#include "tests/vehicles/submarine_oracle.h"

#include <algorithm>
#include <cmath>

namespace jarol::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond attitude(const Eigen::Matrix<double, 13, 1>& state) {
  return Quaterniond(state[6], state[3], state[4], state[5]).normalized();
}

// volume of the part of a unit sphere below a plane at this height over its centre, as a part of the whole
double cap(double height) {
  if (height <= -1.0) return 0.0;
  if (height >= 1.0) return 1.0;
  return (2.0 + 3.0 * height - height * height * height) / 4.0;
}

double square(double x) { return x * std::abs(x); }

}  // namespace

SubmarineOracle::SubmarineOracle(const vehicles::SubmarineParameters& parameters, double depth, double surge)
    : parameters_(parameters) {
  const auto& h = parameters.hull;
  const auto& a = parameters.added_mass;
  // kinetic energy of the mass: v_g = v + omega x (0, 0, z_g)
  const double c = h.mass * h.z_g;
  mass_ << h.mass - a.X_u_dot, 0, 0, 0, c, 0,       //
      0, h.mass - a.Y_v_dot, 0, -c, 0, -a.Y_r_dot,  //
      0, 0, h.mass - a.Z_w_dot, 0, -a.Z_q_dot, 0,   //
      0, -c, 0, h.I_x - a.K_p_dot, 0, 0,            //
      c, 0, -a.Z_q_dot, 0, h.I_y - a.M_q_dot, 0,    //
      0, -a.Y_r_dot, 0, 0, 0, h.I_z - a.N_r_dot;

  Vector6 nu = Vector6::Zero();
  nu[0] = surge;
  const Vector6 momentum = mass_ * nu;
  state_.setZero();
  state_[2] = depth;
  state_[6] = 1.0;
  state_.segment<3>(7) = momentum.head<3>();
  state_.segment<3>(10) = momentum.tail<3>() + position().cross(Vector3d(momentum.head<3>()));
}

Matrix3d SubmarineOracle::rotation() const { return attitude(state_).toRotationMatrix(); }

SubmarineOracle::Vector6 SubmarineOracle::calc_velocity(const State& state) const {
  const Quaterniond q = attitude(state).conjugate();
  const Vector3d r = state.segment<3>(0);
  const Vector3d P = state.segment<3>(7);
  const Vector3d H = state.segment<3>(10);
  Vector6 momentum;
  momentum << q * P, q * (H - r.cross(P));
  return mass_.ldlt().solve(momentum);
}

// weight, buoyancy and damping, component by component
SubmarineOracle::Vector6 SubmarineOracle::calc_loads(const Vector6& nu, double z, const Vector3d& down) const {
  const auto& h = parameters_.hull;
  const double W = h.mass * parameters_.sea.gravity;
  const double along = 0.5 * h.length * down.x();
  const double across = 0.5 * h.diameter * std::hypot(down.y(), down.z());
  const double reach = std::hypot(along, across);
  const double height = z / reach;
  const double part = cap(height);

  // centre of a spherical cap: 3 (1 - height)^2 / (4 (2 - height)) from the sphere's centre, with the larger cap's sign
  Vector3d centre = Vector3d::Zero();
  if (part > 0.0 && part < 1.0) {
    const double t = 0.75 * (1.0 - height) * (1.0 - height) / (2.0 - height);
    const double a2 = 0.25 * h.length * h.length;
    const double b2 = 0.25 * h.diameter * h.diameter;
    centre = t / reach * Vector3d(a2 * down.x(), b2 * down.y(), b2 * down.z());
  }
  const Vector3d force = (W - h.buoyancy * part) * down;
  const Vector3d moment = Vector3d(0, 0, h.z_g).cross(W * down) - centre.cross(h.buoyancy * part * down);

  const auto& l = parameters_.linear_damping;
  const auto& d = parameters_.quadratic_damping;
  const auto& b = parameters_.lift;
  const double u = nu[0], v = nu[1], w = nu[2], p = nu[3], q = nu[4], r = nu[5], s = std::abs(nu[0]);
  Vector6 drag;
  drag << l.X_u * u + d.X_uu * square(u),
      l.Y_v * v + l.Y_r * r + d.Y_vv * square(v) + d.Y_rr * square(r) + s * (b.Y_uv * v + b.Y_ur * r),
      l.Z_w * w + l.Z_q * q + d.Z_ww * square(w) + d.Z_qq * square(q) + s * (b.Z_uw * w + b.Z_uq * q),
      l.K_p * p + d.K_pp * square(p),
      l.M_q * q + l.M_w * w + d.M_qq * square(q) + d.M_ww * square(w) + s * (b.M_uw * w + b.M_uq * q),
      l.N_r * r + l.N_v * v + d.N_rr * square(r) + d.N_vv * square(v) + s * (b.N_uv * v + b.N_ur * r);
  Vector6 loads = part * drag;
  loads.head<3>() += force;
  loads.tail<3>() += moment;
  return loads;
}

SubmarineOracle::State SubmarineOracle::calc_rate(const State& state, double thrust,
                                                  const std::array<double, 4>& fins) const {
  const Quaterniond q = attitude(state);
  const Vector3d down = q.conjugate() * Vector3d::UnitZ();
  const Vector6 nu = calc_velocity(state);
  Vector6 tau = calc_loads(nu, state[2], down);

  // fins 0 bottom, 1 port, 2 starboard, 3 top
  const auto& f = parameters_.fins;
  const std::array<Vector3d, 4> at = {Vector3d(f.x, 0, f.radius), Vector3d(f.x, -f.radius, 0),
                                      Vector3d(f.x, f.radius, 0), Vector3d(f.x, 0, -f.radius)};
  for (std::size_t i = 0; i < 4; ++i) {
    const double delta = std::min(std::max(fins[i], -f.stall), f.stall);
    const double wet = cap((state[2] + down.dot(at[i])) / f.half_span);
    const double lift = wet * f.lift * delta * square(nu[0]);
    const Vector3d force(-wet * f.drag * delta * delta * square(nu[0]), i % 3 == 0 ? lift : 0.0,
                         i % 3 == 0 ? 0.0 : -lift);
    tau.head<3>() += force;
    tau.tail<3>() += at[i].cross(force);
  }
  tau[0] += thrust * cap((state[2] + down.x() * parameters_.thruster.x) / parameters_.thruster.radius);

  State rate;
  rate.segment<3>(0) = q * Vector3d(nu.head<3>());
  const Quaterniond spin(0.0, nu[3], nu[4], nu[5]);
  rate.segment<4>(3) = 0.5 * (q * spin).coeffs();
  const Vector3d force = q * Vector3d(tau.head<3>());
  rate.segment<3>(7) = force;
  rate.segment<3>(10) = q * Vector3d(tau.tail<3>()) + state.segment<3>(0).cross(force);
  return rate;
}

void SubmarineOracle::advance(double seconds, double thrust, const std::array<double, 4>& fins) {
  const int count = static_cast<int>(std::ceil(seconds / 1e-3 - 1e-6));
  const double h = seconds / count;
  for (int i = 0; i < count; ++i) {
    const State k1 = calc_rate(state_, thrust, fins);
    const State k2 = calc_rate(state_ + 0.5 * h * k1, thrust, fins);
    const State k3 = calc_rate(state_ + 0.5 * h * k2, thrust, fins);
    const State k4 = calc_rate(state_ + h * k3, thrust, fins);
    state_ += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    state_.segment<4>(3).normalize();
  }
}

}  // namespace jarol::test
