#include "tasks/javiator/blind_observer.h"

#include <Eigen/Geometry>
#include <cmath>

#include "graph/math/geometry.h"

namespace jarol::tasks {
namespace {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;
using Matrix = Eigen::Matrix<double, 5, 5>;
using Vector = Eigen::Matrix<double, 5, 1>;

constexpr double gravity = 9.81;

Eigen::Map<Matrix> covariance_of(LeanAxis& axis) { return Eigen::Map<Matrix>(axis.covariance.data()); }

// How well these are known when an IMU falls silent, or has reported the same for a while.
void begin(LeanAxis& axis) {
  const Vector deviations(0.003, 0.03, 0.01, 0.05, 1.0);
  covariance_of(axis) = deviations.cwiseAbs2().asDiagonal();
}

// Of place, speed, lean, rate and wind one period on, beside what rotors and mean wind do.
Matrix transition(const BlindObserver::Param& p, double lift, double dt) {
  Matrix F = Matrix::Identity();
  const double half = 0.5 * dt * dt;
  F(0, 1) = dt;
  F(0, 2) = lift * half;
  F(1, 1) = 1 - p.drag * dt;
  F(1, 2) = lift * dt;
  F(1, 3) = lift * half;
  F(1, 4) = p.drag * dt;
  F(2, 3) = dt - p.damping * half;
  F(2, 4) = p.hub * half;
  F(3, 1) = -p.hub * dt;
  F(3, 3) = 1 - p.damping * dt;
  F(3, 4) = p.hub * dt;
  F(4, 4) = 1 - dt / p.gust_time;
  return F;
}

void predict(LeanAxis& axis, const Matrix& F, double turning, double dt) {
  const Vector mean = F * Vector(axis.place, axis.speed, axis.lean, axis.rate, axis.wind);
  axis.place = mean(0) + 0.5 * axis.drag * dt * dt;
  axis.speed = mean(1) + axis.drag * dt;
  axis.lean = mean(2) + 0.5 * turning * dt * dt;
  axis.rate = mean(3) + turning * dt;
  axis.since += dt;
}

void spread(LeanAxis& axis, const BlindObserver::Param& p, const Matrix& F, double dt) {
  Eigen::Map<Matrix> P = covariance_of(axis);
  const Matrix FP = F.lazyProduct(P);
  P = FP.lazyProduct(F.transpose());
  P(1, 1) += p.force_noise * p.force_noise * dt;
  P(3, 3) += p.torque_noise * p.torque_noise * dt;
  P(4, 4) += 2 * p.gusts * p.gusts / p.gust_time * dt;
}

// A place is measured by a ray that leans as the vehicle does.
void correct(LeanAxis& axis, const PlaceFix& fix, const BlindObserver::Param& p) {
  if (!fix.is_new) return;
  Eigen::Map<Matrix> P = covariance_of(axis);
  const Vector PH = P.col(0) - fix.slope * P.col(2);
  // it grows with the lean's square as well
  const double bend = std::abs(fix.range) * P(2, 2);
  const double noise = std::hypot(p.range_noise, p.yaw_noise * fix.skew);
  const Vector gain = PH / (PH(0) - fix.slope * PH(2) + noise * noise + 0.5 * bend * bend);
  const double residual = fix.place + 0.5 * bend - axis.place;
  axis.place += gain(0) * residual;
  axis.speed += gain(1) * residual;
  axis.lean += gain(2) * residual;
  axis.rate += gain(3) * residual;
  axis.wind += gain(4) * residual;
  P -= gain.lazyProduct(PH.transpose());
  axis.since = 0;
}

void follow(double& mean, double value, double part) { mean += part * (value - mean); }

// Demands as they are felt, one period late and through the rotors' lag.
void feel(BlindObserver::State& state, double lag, double dt) {
  const double part = dt / (lag + dt);
  follow(state.felt.roll, state.last.roll, part);
  follow(state.felt.pitch, state.last.pitch, part);
  follow(state.felt_thrust, state.last_thrust, part);
}

}  // namespace

void BlindObserver::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  const double dt = seconds(tick.period);
  if (e.rates_known) {
    const double part = dt / (p.mean_time + dt);
    follow(state.mean.roll, in.turn.roll, part);
    follow(state.mean.pitch, in.turn.pitch, part);
    follow(state.mean.yaw, in.turn.yaw, part);
    follow(state.mean_thrust, in.lift.thrust, part);
    follow(state.lift, e.lift + p.inflow * e.climb, part);
    follow(state.x.drag, e.drag_x + p.drag * e.v_x, part);
    follow(state.y.drag, e.drag_y + p.drag * e.v_y, part);
    const Rotation2Dd to_earth(e.heading);
    const Vector2d lean = to_earth * Vector2d(-e.pitch, e.roll), rate = to_earth * Vector2d(-e.q, e.p);
    state.x = {.place = e.x, .speed = e.v_x, .lean = lean.x(), .rate = rate.x(), .drag = state.x.drag};
    state.y = {.place = e.y, .speed = e.v_y, .lean = lean.y(), .rate = rate.y(), .drag = state.y.drag};
    state.heading = e.heading;
    state.yaw = e.yaw;
    state.yaw_rate = e.r;
    state.turns = std::abs(e.r) > p.turn_limit;
    state.mean_wind = std::hypot(state.x.drag, state.y.drag) / p.drag;
  } else {
    if (!state.is_blind) {
      begin(state.x);
      begin(state.y);
    }
    correct(state.x, e.fix_x, p);
    correct(state.y, e.fix_y, p);
  }
  state.is_blind = !e.rates_known;
  feel(state, p.lag, dt);
  const Vector2d turning = Rotation2Dd(state.heading) * Vector2d(-p.effect * (state.felt.pitch - state.mean.pitch),
                                                                 p.effect * (state.felt.roll - state.mean.roll));
  const double lift = state.lift + gravity * (state.felt_thrust - state.mean_thrust) - p.inflow * e.climb;
  const Matrix F = transition(p, lift, dt);
  predict(state.x, F, turning.x(), dt);
  predict(state.y, F, turning.y(), dt);
  if (state.is_blind) {
    spread(state.x, p, F, dt);
    spread(state.y, p, F, dt);
  }
  const double turned = (state.yaw_rate + 0.5 * p.yaw_effect * (state.last.yaw - state.mean.yaw) * dt) * dt;
  state.yaw += turned;
  state.heading += turned;
  state.yaw_rate +=
      p.yaw_effect * ((state.last.yaw - state.mean.yaw) * dt + p.spin_time * (in.turn.yaw - state.last.yaw));
  state.last = in.turn;
  state.last_thrust = in.lift.thrust;

  const Rotation2Dd to_body(-state.heading);
  const Vector2d lean = to_body * Vector2d(state.x.lean, state.y.lean);
  const Vector2d rate = to_body * Vector2d(state.x.rate, state.y.rate);
  out.motion = {.roll = lean.y(),
                .pitch = -lean.x(),
                .yaw = state.yaw,
                .p = rate.y(),
                .q = -rate.x(),
                .r = state.yaw_rate,
                .x = state.x.place,
                .y = state.y.place,
                .v_x = state.x.speed,
                .v_y = state.y.speed,
                .drag_x = state.x.drag,
                .drag_y = state.y.drag,
                .lift = lift,
                .known = !state.turns && state.mean_wind > p.least_wind && state.x.since < p.patience &&
                         state.y.since < p.patience};
}

}  // namespace jarol::tasks
