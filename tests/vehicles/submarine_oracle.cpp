#include "tests/vehicles/submarine_oracle.h"

#include <algorithm>
#include <cmath>
#include <complex>

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
    : parameters_(parameters), density_(parameters.sea.density / parameters.hull.water_density) {
  const auto& h = parameters.hull;
  const auto& a = parameters.added_mass;
  // kinetic energy of the mass: v_g = v + omega x (0, 0, z_g)
  const double c = h.mass * h.z_g;
  Eigen::Matrix<double, 6, 6> mass;
  mass << h.mass, 0, 0, 0, c, 0,  //
      0, h.mass, 0, -c, 0, 0,     //
      0, 0, h.mass, 0, 0, 0,      //
      0, -c, 0, h.I_x, 0, 0,      //
      c, 0, 0, 0, h.I_y, 0,       //
      0, 0, 0, 0, 0, h.I_z;
  added_ << a.X_u_dot, 0, 0, 0, 0, 0,    //
      0, a.Y_v_dot, 0, 0, 0, a.Y_r_dot,  //
      0, 0, a.Z_w_dot, 0, a.Z_q_dot, 0,  //
      0, 0, 0, a.K_p_dot, 0, 0,          //
      0, 0, a.Z_q_dot, 0, a.M_q_dot, 0,  //
      0, a.Y_r_dot, 0, 0, 0, a.N_r_dot;
  added_ *= -density_;
  mass += added_;
  inverse_mass_ = mass.inverse();

  Vector6 nu = Vector6::Zero();
  nu[0] = surge + parameters.sea.current_north;
  nu[1] = parameters.sea.current_east;
  const Vector6 momentum = mass * nu;
  state_.setZero();
  state_[2] = depth;
  state_[6] = 1.0;
  state_.tail<6>() = momentum;
}

// Airy's waves as the gradient of a potential, carried along by the current
Vector3d SubmarineOracle::water(double time, const Vector3d& place) const {
  const auto& sea = parameters_.sea;
  const Vector3d current(sea.current_north, sea.current_east, 0.0);
  if (sea.wave_height == 0.0) return current;
  const double omega = 2.0 * M_PI / sea.wave_period, k = omega * omega / 9.81;
  const Vector3d ahead(std::cos(sea.wave_direction), std::sin(sea.wave_direction), 0.0);
  const Vector3d still = place - current * time;
  const std::complex<double> wave =
      std::polar(0.5 * sea.wave_height * omega * std::exp(-k * still.z()), k * ahead.dot(still) - omega * time);
  return current + wave.real() * ahead - wave.imag() * Vector3d::UnitZ();
}

double SubmarineOracle::surface(double time, const Vector3d& place) const {
  const auto& sea = parameters_.sea;
  const double omega = 2.0 * M_PI / sea.wave_period, k = omega * omega / 9.81;
  const double way = std::cos(sea.wave_direction) * (place.x() - sea.current_north * time) +
                     std::sin(sea.wave_direction) * (place.y() - sea.current_east * time);
  return -0.5 * sea.wave_height * std::cos(k * way - omega * time);
}

Matrix3d SubmarineOracle::rotation() const { return attitude(state_).toRotationMatrix(); }

SubmarineOracle::Vector6 SubmarineOracle::calc_velocity(const State& state) const {
  const Quaterniond q = attitude(state).conjugate();
  Vector6 momentum;
  momentum << q * Vector3d(state.segment<3>(7)), q * Vector3d(state.segment<3>(10));
  return inverse_mass_ * momentum;
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
  const double B = density_ * h.buoyancy * part;
  const Vector3d force = (W - B) * down;
  const Vector3d moment = Vector3d(0, 0, h.z_g).cross(W * down) - centre.cross(B * down);

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
  Vector6 loads = density_ * part * drag;
  loads.head<3>() += force;
  loads.tail<3>() += moment;
  return loads;
}

// fins 0 bottom, 1 port, 2 starboard, 3 top, and the propeller
SubmarineOracle::Vector6 SubmarineOracle::calc_actuators(const Vector6& nu_r, double z, const Vector3d& down,
                                                         double propeller, const std::array<double, 4>& fins) const {
  const auto& f = parameters_.fins;
  const std::array<Vector3d, 4> at = {Vector3d(f.x, 0, f.radius), Vector3d(f.x, -f.radius, 0),
                                      Vector3d(f.x, f.radius, 0), Vector3d(f.x, 0, -f.radius)};
  Vector6 tau = Vector6::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    const double delta = std::min(std::max(fins[i], -f.stall), f.stall);
    const double wet = density_ * cap((z + down.dot(at[i])) / f.half_span);
    const double lift = wet * f.lift * delta * square(nu_r[0]);
    const Vector3d force(-wet * f.drag * delta * delta * square(nu_r[0]), i % 3 == 0 ? lift : 0.0,
                         i % 3 == 0 ? 0.0 : -lift);
    tau.head<3>() += force;
    tau.tail<3>() += at[i].cross(force);
  }
  const auto& t = parameters_.thruster;
  const double thrust =
      density_ * (t.thrust_coefficient * square(propeller) - t.advance_coefficient * std::abs(propeller) * nu_r[0]);
  tau[0] += std::min(std::max(thrust, -t.max_thrust), t.max_thrust) * cap((z + down.x() * t.x) / t.radius);
  return tau;
}

SubmarineOracle::State SubmarineOracle::calc_rate(double time, const State& state, double propeller,
                                                  const std::array<double, 4>& fins) const {
  const Quaterniond q = attitude(state);
  const Vector3d place = state.segment<3>(0), down = q.conjugate() * Vector3d::UnitZ();
  const Vector6 nu = calc_velocity(state);
  const Vector3d v = nu.head<3>(), omega = nu.tail<3>();

  const Vector3d flow = water(time, place);
  constexpr double h = 1e-4;
  const Vector3d rate_of_flow = (water(time + h, place + h * flow) - water(time - h, place - h * flow)) / (2 * h);
  const Vector3d c = q.conjugate() * flow, c_dot = q.conjugate() * rate_of_flow;
  Vector6 nu_r = nu, c6 = Vector6::Zero(), turn = Vector6::Zero();
  nu_r.head<3>() -= c;
  c6.head<3>() = c;
  turn.head<3>() = c_dot - omega.cross(c);

  const double z = place.z() - surface(time, place);
  Vector6 tau = calc_loads(nu_r, z, down) + calc_actuators(nu_r, z, down, propeller, fins) + added_ * turn;
  const Vector6 carried = added_ * c6, along = added_ * nu_r;
  const Vector3d own = parameters_.hull.mass * (v + omega.cross(Vector3d(0, 0, parameters_.hull.z_g)));
  tau.head<3>() +=
      density_ * parameters_.hull.buoyancy / parameters_.sea.gravity * c_dot + omega.cross(Vector3d(carried.head<3>()));
  tau.tail<3>() += omega.cross(Vector3d(carried.tail<3>())) - v.cross(own) -
                   Vector3d(nu_r.head<3>()).cross(Vector3d(along.head<3>()));

  State rate;
  rate.segment<3>(0) = q * v;
  rate.segment<4>(3) = 0.5 * (q * Quaterniond(0.0, nu[3], nu[4], nu[5])).coeffs();
  rate.segment<3>(7) = q * Vector3d(tau.head<3>());
  rate.segment<3>(10) = q * Vector3d(tau.tail<3>());
  return rate;
}

void SubmarineOracle::advance(double seconds, double propeller, const std::array<double, 4>& fins) {
  const int count = static_cast<int>(std::ceil(seconds / 1e-3 - 1e-6));
  const double h = seconds / count;
  for (int i = 0; i < count; ++i) {
    const State k1 = calc_rate(time_, state_, propeller, fins);
    const State k2 = calc_rate(time_ + 0.5 * h, state_ + 0.5 * h * k1, propeller, fins);
    const State k3 = calc_rate(time_ + 0.5 * h, state_ + 0.5 * h * k2, propeller, fins);
    const State k4 = calc_rate(time_ + h, state_ + h * k3, propeller, fins);
    state_ += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    state_.segment<4>(3).normalize();
    time_ += h;
  }
}

}  // namespace jarol::test
