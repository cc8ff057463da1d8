#include "tasks/javiator/original_filter.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"
#include "graph/math/rotations.h"
#include "tasks/add_task.h"

namespace jarol::tasks {
namespace {

using Eigen::Vector3d;

constexpr double gravity_mm = 9810;  // mm/s^2

// one look-ahead of a period: the rate counts for two of them
void filter_angle(double& angle, double measured, double rate, double dt) {
  constexpr double R = 0.01;
  const double Q = 10 * (2 * dt) * (2 * dt);
  const double P = 0.5 * (Q + std::sqrt(Q * Q + 4 * Q * R));  // at rest
  angle += 2 * dt * rate;
  angle += P / (P + R) * (measured - angle);
}

void predict(AxisKalman& k, double acceleration, double dt) {
  constexpr double variance = 10000;
  k.acceleration += 0.2 * (acceleration - k.acceleration);
  k.place += k.speed * dt + 0.5 * k.acceleration * dt * dt;
  k.speed += k.acceleration * dt;
  k.P00 += dt * (2 * k.P01 + dt * k.P11) + variance * dt * dt * dt * dt / 4;
  k.P01 += dt * k.P11 + variance * dt * dt * dt / 2;
  k.P11 += variance * dt * dt;
  k.since += dt;
}

// the place is measured, and the speed as its difference quotient
void correct(AxisKalman& k, double measured) {
  constexpr double R_place = 0.01, R_speed = 100;
  const double place_error = measured - k.place;
  const double speed_error = (measured - k.last) / k.since - k.speed;
  const double S00 = k.P00 + R_place, S01 = k.P01, S11 = k.P11 + R_speed;
  const double det = S00 * S11 - S01 * S01;
  const double K00 = (k.P00 * S11 - k.P01 * S01) / det, K01 = (k.P01 * S00 - k.P00 * S01) / det;
  const double K10 = (k.P01 * S11 - k.P11 * S01) / det, K11 = (k.P11 * S00 - k.P01 * S01) / det;
  k.place += K00 * place_error + K01 * speed_error;
  k.speed += K10 * place_error + K11 * speed_error;
  const double P00 = (1 - K00) * k.P00 - K01 * k.P01, P01 = (1 - K00) * k.P01 - K01 * k.P11;
  const double P11 = (1 - K11) * k.P11 - K10 * k.P01;
  k.P00 = P00;
  k.P01 = P01;
  k.P11 = P11;
  k.last = measured;
  k.since = 0;
}

void step(AxisKalman& k, double acceleration, bool is_new, double measured, bool settled, double& zero, double dt) {
  if (settled) {
    if (is_new) zero = measured;
    k = {.acceleration = k.acceleration + 0.2 * (acceleration - k.acceleration)};
    return;
  }
  predict(k, acceleration, dt);
  if (is_new) correct(k, measured - zero);
}

}  // namespace

void OriginalFilter::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const JaviatorSensors& s = in.sensors;
  FlightEstimate& e = out.estimate;
  const double dt = seconds(tick.period);
  const bool fresh = s.answers != state.answers;
  state.answers = s.answers;
  // not before its motors stand: it may still be in the air
  constexpr double run_down = 2.4;  // s
  const bool is_off = in.directive.state == FlightState::halt || in.directive.state == FlightState::ground;
  state.turning = is_off ? std::max(state.turning - dt, 0.0) : run_down;
  const bool settled = is_off && state.turning == 0;

  // where and as it stands before take-off is the origin, and its heading zero
  if (settled) state.zero_yaw = state.unwrapped_yaw = s.yaw;
  state.unwrapped_yaw += wrapped(s.yaw - state.unwrapped_yaw);
  const double yaw = state.unwrapped_yaw - state.zero_yaw;

  const Vector3d rates = euler_rates(s.roll, s.pitch, {s.p, s.q, s.r});
  filter_angle(state.roll, s.roll, rates.x(), dt);
  filter_angle(state.pitch, s.pitch, rates.y(), dt);
  filter_angle(state.yaw, yaw, rates.z(), dt);
  if (settled) state.yaw = 0;

  const Eigen::Matrix3d R = rotation_of(s.roll, s.pitch, s.yaw);
  const Vector3d a = R * (1e3 * Vector3d(s.a_x, s.a_y, s.a_z)) + Vector3d(0, 0, gravity_mm);
  // its constants of the lasers lead from these to the centre of gravity
  const Vector3d sonar_b(-95, -95, 55), laser_x_b(-70, 75, 80), laser_y_b(50, -77, 80);
  const double z = (R * (sonar_b + Vector3d(0, 0, 1e3 * s.sonar))).z();
  const Eigen::Vector2d expected = 1e-3 * Eigen::Vector2d(state.zero_x + state.x.place, state.zero_y + state.y.place);
  const WallFix ahead = find_place(p.room, 1e-3 * (R * laser_x_b), R.col(0), s.laser_x, expected);
  const WallFix right = find_place(p.room, 1e-3 * (R * laser_y_b), R.col(1), s.laser_y, expected);
  const auto step_along = [&](int axis, AxisKalman& k, double acceleration, double& zero) {
    const bool by_ahead = fresh && s.new_x && ahead.seen && ahead.axis == axis;
    const bool by_right = fresh && s.new_y && right.seen && right.axis == axis;
    step(k, acceleration, by_ahead || by_right, 1e3 * (by_ahead ? ahead.place : right.place), settled, zero, dt);
  };
  step_along(0, state.x, a.x(), state.zero_x);
  step_along(1, state.y, a.y(), state.zero_y);
  step(state.z, -a.z(), fresh && s.new_sonar, z, settled, state.zero_z, dt);
  state.z.place = std::max(state.z.place, 0.0);

  e = {.roll = state.roll - in.directive.trim_roll,
       .pitch = state.pitch - in.directive.trim_pitch,
       .yaw = state.yaw,
       .heading = state.zero_yaw + state.yaw,
       .p = s.p,
       .q = s.q,
       .r = s.r,
       .x = 1e-3 * state.x.place,
       .y = 1e-3 * state.y.place,
       .altitude = 1e-3 * state.z.place,
       .v_x = 1e-3 * state.x.speed,
       .v_y = 1e-3 * state.y.speed,
       .climb = 1e-3 * state.z.speed,
       .a_x = 1e-3 * state.x.acceleration,
       .a_y = 1e-3 * state.y.acceleration,
       .a_up = 1e-3 * state.z.acceleration,
       .battery = s.battery,
       .rates_known = true,
       .attitude_known = true,
       .altitude_known = true,
       .position_known = true,
       .pressure_known = true,
       .answers_known = true};
}

template void add_task<OriginalFilter>(Registry&);

}  // namespace jarol::tasks
