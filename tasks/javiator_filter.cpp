#include "tasks/javiator_filter.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace jarol::tasks {
namespace {

using Eigen::Vector3d;

constexpr double gravity = 9.81;
constexpr double pascal_per_metre = 12.0;

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

void predict(AxisObserver& axis, double acceleration, double dt) {
  const double a = acceleration - axis.bias;
  axis.place += axis.speed * dt + 0.5 * a * dt * dt;
  axis.speed += a * dt;
  axis.silent += dt;
}

// gains of the critically damped filter of third order, with its poles at e^(-bandwidth T) (Brookner, "Tracking and
// Kalman Filtering Made Easy", 1998, sec. 1.3)
void correct(AxisObserver& axis, double measured, const JaviatorFilter::Param& p) {
  const double residual = measured - axis.place;
  if (axis.silent < p.patience && std::abs(residual) > p.jump) return;
  if (axis.silent >= p.patience) {
    axis = {.place = measured, .speed = axis.speed, .bias = axis.bias};
    return;
  }
  const double T = axis.silent;
  const double pole = std::exp(-p.bandwidth * T);
  axis.place += (1 - pole * pole * pole) * residual;
  axis.speed += 1.5 * (1 - pole) * (1 - pole) * (1 + pole) * residual / T;
  axis.bias -= std::pow(1 - pole, 3) * residual / (T * T);
  axis.silent = 0;
}

// standing still, the measurement is the zero of what follows
void settle(AxisObserver& axis, double acceleration, bool is_new, double dt) {
  axis.silent = is_new ? 0 : axis.silent + dt;
  axis.place = axis.speed = 0;
  axis.bias += 0.02 * (acceleration - axis.bias);
}

}  // namespace

void JaviatorFilter::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const JaviatorSensors& s = in.sensors;
  FlightEstimate& e = out.estimate;
  const double dt = 1e-9 * static_cast<double>(tick.period.count());
  const bool fresh = s.answers != state.answers;
  state.answers = s.answers;
  const FlightState doing = in.directive.state;
  const bool settled = doing == FlightState::halt || doing == FlightState::ground;
  state.imu_silent = fresh && s.new_imu ? 0 : state.imu_silent + dt;

  if (settled) {
    state.zero_yaw = s.yaw;
    state.yaw = 0;
  }
  state.yaw += wrapped(s.yaw - state.zero_yaw - state.yaw);

  const Eigen::Matrix3d R =
      (Eigen::AngleAxisd(state.yaw, Vector3d::UnitZ()) * Eigen::AngleAxisd(s.pitch, Vector3d::UnitY()) *
       Eigen::AngleAxisd(s.roll, Vector3d::UnitX()))
          .toRotationMatrix();
  const Vector3d a = R * Vector3d(s.a_x, s.a_y, s.a_z) + Vector3d(0, 0, gravity);
  const double x = (R * Vector3d(p.laser_x_x, p.laser_x_y, p.laser_x_z)).x() - s.laser_x;
  const double y = (R * Vector3d(p.laser_y_x, p.laser_y_y, p.laser_y_z)).y() - s.laser_y;
  const double z = (R * Vector3d(p.sonar_x, p.sonar_y, p.sonar_z + s.sonar)).z();
  const bool new_x = fresh && s.new_x, new_y = fresh && s.new_y, new_z = fresh && s.new_sonar;

  if (settled) {
    if (new_x) state.zero_x = x;
    if (new_y) state.zero_y = y;
    if (new_z) state.zero_z = z;
    if (fresh && s.new_bmu) state.zero_pressure = s.pressure;
    settle(state.x, a.x(), new_x, dt);
    settle(state.y, a.y(), new_y, dt);
    settle(state.z, -a.z(), new_z, dt);
  } else {
    predict(state.x, a.x(), dt);
    predict(state.y, a.y(), dt);
    predict(state.z, -a.z(), dt);
    if (new_x) correct(state.x, x - state.zero_x, p);
    if (new_y) correct(state.y, y - state.zero_y, p);
    if (new_z) correct(state.z, z - state.zero_z, p);
  }
  e.altitude_known = state.z.silent < p.patience;
  // without a sonar the barometer has to do
  if (!e.altitude_known && !settled && fresh && s.new_bmu) {
    const double residual = (state.zero_pressure - s.pressure) / pascal_per_metre - state.z.place;
    state.z.place += 0.1 * residual;
    state.z.speed += 0.1 * residual;
  }

  e.attitude_known = state.imu_silent < 5 * dt;
  e.position_known = state.x.silent < p.patience && state.y.silent < p.patience;
  e.roll = s.roll + p.age * s.p;
  e.pitch = s.pitch + p.age * s.q;
  e.yaw = state.yaw + p.age * s.r;
  e.p = s.p;
  e.q = s.q;
  e.r = s.r;
  e.x = state.x.place;
  e.y = state.y.place;
  e.altitude = state.z.place;
  e.v_x = state.x.speed;
  e.v_y = state.y.speed;
  e.climb = state.z.speed;
  e.a_x = a.x() - state.x.bias;
  e.a_y = a.y() - state.y.bias;
  e.a_up = -a.z() - state.z.bias;
  // an accelerometer in flight feels the rotors along their axis, and drag across it
  const Vector3d drag = R * Vector3d(s.a_x, s.a_y, 0);
  e.lift = -s.a_z;
  e.drag_x = drag.x();
  e.drag_y = drag.y();
  e.battery = e.battery == 0 ? s.battery : e.battery + dt * (s.battery - e.battery);
}

}  // namespace jarol::tasks
