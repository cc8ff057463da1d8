#include "tasks/javiator/blind_observer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"
#include "tasks/add_task.h"

namespace jarol::tasks {
namespace {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;
using Matrix = Eigen::Matrix<double, 5, 5>;
using Vector = Eigen::Matrix<double, 5, 1>;

Eigen::Map<Matrix> covariance_of(LeanGuess& guess) { return Eigen::Map<Matrix>(guess.covariance.data()); }

// What is known when an IMU falls silent, or has reported the same for a while. A ray is as long for a lean towards its
// wall as for one away from it, and winds turn it to either side: each guess is of another wind.
void begin(LeanAxis& axis, const BlindObserver::Param& p) {
  const BlindStart& start = p.start;
  const Vector deviations(start.place, start.speed, start.lean, start.rate, start.wind_width * p.gusts);
  double sum = 0;
  for (std::size_t i = 0; i < axis.guesses.size(); ++i) {
    LeanGuess& guess = axis.guesses[i] = axis.mean;
    const double off = start.wind_apart * (static_cast<double>(i) - 2);
    guess.wind = off * p.gusts;
    guess.weight = std::exp(-0.5 * off * off);
    sum += guess.weight;
    covariance_of(guess) = deviations.cwiseAbs2().asDiagonal();
  }
  for (LeanGuess& guess : axis.guesses) guess.weight /= sum;
}

// Near the ground thrust grows by 1 / (1 - (R/4h)^2), and on the lower side more: Cheeseman and Bennett, "The Effect of
// the Ground on a Helicopter Rotor in Forward Flight", 1955.
struct GroundEffect {
  double gain, slope;  // of thrust; and by how much it grows, 1/m downwards
};

GroundEffect find_ground_effect(const BlindObserver::Param& p, double altitude) {
  const double height = std::max(altitude, 0.0) + p.rotor_height, ratio = p.rotor_radius / (4 * height);
  const double gain = 1 / (1 - ratio * ratio);
  return {gain, 2 * ratio * ratio * gain * gain / height};
}

// Of place, speed, lean, rate and wind one period on, beside what rotors and mean wind do.
// The slower the rotors turn (1 is as they did), the less the air that flows past holds and turns it.
Matrix transition(const BlindObserver::Param& p, double lift, double spin, double stiffness, double dt) {
  Matrix F = Matrix::Identity();
  const double half = 0.5 * dt * dt, drag = spin * p.drag, damping = spin * p.damping, hub = spin * p.hub;
  F(0, 1) = dt;
  F(0, 2) = lift * half;
  F(1, 1) = 1 - drag * dt;
  F(1, 2) = lift * dt;
  F(1, 3) = lift * half;
  F(1, 4) = drag * dt;
  F(2, 2) = 1 - stiffness * half;
  F(2, 3) = dt - damping * half;
  F(2, 4) = hub * half;
  F(3, 1) = -hub * dt;
  F(3, 2) = -stiffness * dt;
  F(3, 3) = 1 - damping * dt;
  F(3, 4) = hub * dt;
  F(4, 4) = 1 - std::min(dt / p.gust_time, 1.0);
  return F;
}

void predict(LeanGuess& guess, const Matrix& F, double drag, double turning, double dt) {
  const Vector mean = F * Vector(guess.place, guess.speed, guess.lean, guess.rate, guess.wind);
  guess.place = mean(0) + 0.5 * drag * dt * dt;
  guess.speed = mean(1) + drag * dt;
  guess.lean = mean(2) + 0.5 * turning * dt * dt;
  guess.rate = mean(3) + turning * dt;
  guess.wind = mean(4);
}

void spread(LeanGuess& guess, const BlindObserver::Param& p, const Matrix& F, bool touches, double dt) {
  Eigen::Map<Matrix> P = covariance_of(guess);
  const Matrix FP = F.lazyProduct(P);
  P = FP.lazyProduct(F.transpose());
  const double force = touches ? p.ground_force_noise : p.force_noise;
  const double torque = touches ? p.ground_torque_noise : p.torque_noise;
  P(1, 1) += force * force * dt;
  P(3, 3) += torque * torque * dt;
  P(4, 4) += 2 * p.gusts * p.gusts / p.gust_time * dt;
}

void average(LeanAxis& axis) {
  LeanGuess mean{.weight = 1};
  for (const LeanGuess& guess : axis.guesses) {
    mean.place += guess.weight * guess.place;
    mean.speed += guess.weight * guess.speed;
    mean.lean += guess.weight * guess.lean;
    mean.rate += guess.weight * guess.rate;
    mean.wind += guess.weight * guess.wind;
  }
  axis.mean = mean;
}

// By what a measurement z of variance S, with z = H s, differs from what it expects; PH is P H^T.
void update(LeanGuess& guess, const Vector& PH, double variance, double residual) {
  const Vector gain = PH / variance;
  guess.place += gain(0) * residual;
  guess.speed += gain(1) * residual;
  guess.lean += gain(2) * residual;
  guess.rate += gain(3) * residual;
  guess.wind += gain(4) * residual;
  covariance_of(guess) -= gain.lazyProduct(PH.transpose());
  guess.weight *= std::exp(-0.5 * residual * residual / variance) / std::sqrt(variance);
}

template <class Correct>
void correct_each(LeanAxis& axis, const Correct& correct) {
  constexpr double min_weight = 1e-12;  // no guess is given up
  double sum = 0;
  for (LeanGuess& guess : axis.guesses) {
    correct(guess);
    guess.weight = std::max(guess.weight, min_weight);
    sum += guess.weight;
  }
  for (LeanGuess& guess : axis.guesses) guess.weight /= sum;
}

// A place is measured by a ray that leans as the vehicle does; the one given is that of the mean's lean.
void correct(LeanGuess& guess, const PlaceFix& fix, double taken, const BlindObserver::Param& p) {
  const Eigen::Map<Matrix> P = covariance_of(guess);
  const double off = guess.lean - taken;
  const double slope = fix.slope + fix.range * off;
  const double place = fix.place + (fix.slope + 0.5 * fix.range * off) * off;
  const Vector PH = P.col(0) - slope * P.col(2);
  // it grows with the lean's square as well
  const double bend = std::abs(fix.range) * P(2, 2);
  const double noise = std::hypot(p.range_noise, p.yaw_noise * fix.skew);
  const double variance = PH(0) - slope * PH(2) + noise * noise + 0.5 * bend * bend;
  update(guess, PH, variance, place + std::copysign(0.5 * bend, fix.range) - guess.place);
}

void correct(LeanAxis& axis, const PlaceFix& fix, const BlindObserver::Param& p) {
  if (!fix.is_new) return;
  correct_each(axis, [&](LeanGuess& guess) { correct(guess, fix, axis.mean.lean, p); });
  axis.since = 0;
}

void correct(LeanAxis& axis, double lean, const TiltBySonars& sonars) {
  correct_each(axis, [&](LeanGuess& guess) {
    const Eigen::Map<Matrix> P = covariance_of(guess);
    const Vector PH = P.col(2) - sonars.age * P.col(3);
    const double variance = PH(2) - sonars.age * PH(3) + sonars.noise * sonars.noise;
    update(guess, PH, variance, lean - (guess.lean - sonars.age * guess.rate));
  });
}

void follow(double& mean, double value, double part) { mean += part * (value - mean); }

// Sonars show how it leans; while the IMU does, by how much they differ.
void look_down(const BlindObserver::Param& p, const BlindObserver::In& in, double dt, BlindObserver::State& state) {
  const FlightEstimate& e = in.estimate;
  SonarLevel& level = state.level;
  level.since += dt;
  if (in.sonars.readings == level.last.readings) return;
  level.repeats = in.sonars.ranges == level.last.ranges ? level.repeats + 1 : 0;
  level.last = in.sonars;
  const std::optional<Tilt> tilt = find_tilt(p.sonars, in.sonars);
  if (!tilt || !e.altitude_known || level.repeats >= p.sonars.repeats) return;
  if (!e.rates_known) {
    const Vector2d lean = Rotation2Dd(state.heading) * Vector2d(level.pitch - tilt->pitch, tilt->roll - level.roll);
    correct(state.x, lean.x(), p.sonars);
    correct(state.y, lean.y(), p.sonars);
  } else if (e.rates_age == 0 && e.attitude_known) {
    const double part = level.learnt ? std::min(level.since, p.sonars.patience) / p.sonars.mean_time : 1;
    level.learnt = true;
    follow(level.roll, tilt->roll - (e.roll - p.sonars.age * e.p), part);
    follow(level.pitch, tilt->pitch - (e.pitch - p.sonars.age * e.q), part);
  }
  level.since = 0;
}

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
  if (e.rates_known && e.rates_age == 0) {
    const double part = dt / (p.mean_time + dt);
    follow(state.mean_yaw, in.turn.yaw, part);
    follow(state.mean_thrust, in.lift.thrust, part);
    follow(state.lift, e.lift + p.inflow * e.climb, part);
    follow(state.x.drag, e.drag_x + p.drag * e.v_x, part);
    follow(state.y.drag, e.drag_y + p.drag * e.v_y, part);
    const Rotation2Dd to_earth(e.heading);
    // what turns it beside its rotors
    const Vector2d torque = to_earth * Vector2d(-(e.q - state.q) / dt - p.damping * e.q + p.effect * state.felt.pitch,
                                                (e.p - state.p) / dt + p.damping * e.p - p.effect * state.felt.roll);
    state.p = e.p;
    state.q = e.q;
    follow(state.x.torque, torque.x() + p.hub * e.v_x, part);
    follow(state.y.torque, torque.y() + p.hub * e.v_y, part);
    const Vector2d lean = to_earth * Vector2d(-e.pitch, e.roll), rate = to_earth * Vector2d(-e.q, e.p);
    state.x = {.mean = {.weight = 1, .place = e.x, .speed = e.v_x, .lean = lean.x(), .rate = rate.x()},
               .drag = state.x.drag,
               .torque = state.x.torque};
    state.y = {.mean = {.weight = 1, .place = e.y, .speed = e.v_y, .lean = lean.y(), .rate = rate.y()},
               .drag = state.y.drag,
               .torque = state.y.torque};
    state.heading = e.heading;
    state.yaw = e.yaw;
    state.yaw_rate = e.r;
    state.turns = std::abs(e.r) > p.turn_limit;
  } else if (!e.rates_known) {
    if (!state.is_blind) {
      begin(state.x, p);
      begin(state.y, p);
    }
    correct(state.x, e.fixes[0], p);
    correct(state.y, e.fixes[1], p);
  }
  look_down(p, in, dt, state);
  state.is_blind = !e.rates_known;
  feel(state, p.lag, dt);
  const double spin = std::sqrt(std::max(state.felt_thrust, 0.0) / std::max(state.mean_thrust, p.min_thrust));
  const Vector2d turning = p.effect * (Rotation2Dd(state.heading) * Vector2d(-state.felt.pitch, state.felt.roll));
  const GroundEffect ground = find_ground_effect(p, e.altitude);
  const double lift =
      state.lift + gravity * (ground.gain * state.felt_thrust - state.mean_thrust) - spin * p.inflow * e.climb;
  const Matrix F = transition(p, lift, spin, p.effect * p.arm * ground.slope * state.felt_thrust, dt);
  const auto advance = [&](LeanAxis& axis, double turned) {
    const double torque = turned + spin * axis.torque;
    axis.since += dt;
    if (!state.is_blind) return predict(axis.mean, F, spin * axis.drag, torque, dt);
    for (LeanGuess& guess : axis.guesses) {
      predict(guess, F, spin * axis.drag, torque, dt);
      spread(guess, p, F, e.touches, dt);
    }
    average(axis);
  };
  advance(state.x, turning.x());
  advance(state.y, turning.y());
  const double turned = (state.yaw_rate + 0.5 * p.yaw_effect * (state.last.yaw - state.mean_yaw) * dt) * dt;
  state.yaw += turned;
  state.heading += turned;
  state.yaw_rate +=
      p.yaw_effect * ((state.last.yaw - state.mean_yaw) * dt + p.spin_time * (in.turn.yaw - state.last.yaw));
  state.last = in.turn;
  state.last_thrust = in.lift.thrust;

  const bool tilt_known = state.level.since < p.sonars.patience;
  const bool by_lasers = !state.turns && state.x.since < p.patience && state.y.since < p.patience;
  const Rotation2Dd to_body(-state.heading);
  const Vector2d lean = to_body * Vector2d(state.x.mean.lean, state.y.mean.lean);
  const Vector2d rate = to_body * Vector2d(state.x.mean.rate, state.y.mean.rate);
  out.motion = {.roll = lean.y(),
                .pitch = -lean.x(),
                .yaw = state.yaw,
                .p = rate.y(),
                .q = -rate.x(),
                .r = state.yaw_rate,
                .x = state.x.mean.place,
                .y = state.y.mean.place,
                .v_x = state.x.mean.speed,
                .v_y = state.y.mean.speed,
                .drag_x = spin * state.x.drag,
                .drag_y = spin * state.y.drag,
                .lift = lift,
                .known = tilt_known || by_lasers,
                .tilt_known = tilt_known,
                .turns = state.turns};
}

template void add_task<BlindObserver>(Registry&);

}  // namespace jarol::tasks
