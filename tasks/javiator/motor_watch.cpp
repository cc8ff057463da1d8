#include "tasks/javiator/motor_watch.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"
#include "tasks/javiator/rotor_law.h"

namespace jarol::tasks {
namespace {

enum : std::size_t { front, right, rear, left };

RotorLaw law_of(const MotorWatch::Param& p) { return {p.hover, p.exponent, p.voltage}; }

// Signals act 10 ms after the period began in which they were given, the IMU is sampled 5 ms later, and that comes with
// the answer to the next signals: between the newest two samples the oldest signals kept turned the rotors, and then
// those after them.
void spin_up(const MotorWatch::Param& p, const MotorWatch::In& in, double dt, MotorWatch::State& state) {
  const RotorLaw law = law_of(p);
  const double late = std::min(p.sample_time, dt), early = dt - late;
  const double early_part = -std::expm1(-early / p.lag), late_part = -std::expm1(-late / p.lag);
  for (std::size_t i = 0; i < state.reached.size(); ++i) {
    double& reached = state.reached[i];
    reached += early_part * (state.sent[2].signals[i] - reached);
    const double between = law.thrust(reached, in.estimate.battery);
    reached += late_part * (state.sent[1].signals[i] - reached);
    const double now = law.thrust(reached, in.estimate.battery);
    state.thrusts[i] = 0.5 * (early * (state.now[i] + between) + late * (between + now)) / dt;
    state.now[i] = now;
  }
}

// Where an answer is missing, perhaps nothing that was sent of late has been heard.
void doubt_signals(const MotorWatch::Param& p, const MotorWatch::In& in, MotorWatch::State& state) {
  const RotorLaw law = law_of(p);
  std::array<double, 4> unheard{};
  for (std::size_t i = 0; i < unheard.size(); ++i)
    for (const MotorCommand& sent : state.sent)
      unheard[i] = std::max(unheard[i], std::abs(law.thrust(sent.signals[i], in.estimate.battery) - state.thrusts[i]));
  state.doubt = std::max({state.doubt, unheard[front] + unheard[rear], unheard[right] + unheard[left]});
}

// What each motor seems to lack (of hover's thrust), as roll and pitch show that nobody demanded.
std::array<double, 4> lacking(double roll, double pitch) {
  std::array<double, 4> lacks{};
  lacks[front] = -pitch;
  lacks[right] = roll;
  lacks[rear] = pitch;
  lacks[left] = -roll;
  return lacks;
}

// A motor fails faster than wind rises, and turns it about one axis, as wind seldom does.
void find_weak(const MotorWatch::Param& p, double roll, double pitch, double dt, MotorWatch::State& state) {
  const std::array<double, 4> lacks = lacking(roll - state.wind_roll, pitch - state.wind_pitch);
  for (std::size_t i = 0; i < lacks.size(); ++i) {
    const double across = std::abs(lacks[(i + 1) % lacks.size()]);
    state.evidence[i] = std::max(state.evidence[i] + (lacks[i] - across - state.doubt - p.allowance) * dt, 0.0);
    if (state.evidence[i] > p.evidence) state.motors.weak = static_cast<Motor>(i + 1);
  }
  const double part = dt / p.wind_time;
  state.wind_roll = limited(state.wind_roll + part * (roll - state.wind_roll), p.wind);
  state.wind_pitch = limited(state.wind_pitch + part * (pitch - state.wind_pitch), p.wind);
}

}  // namespace

void MotorWatch::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const double dt = seconds(tick.period);
  const FlightEstimate& e = in.estimate;
  const JaviatorSensors& s = in.sensors;
  const FlightState doing = in.directive.state;
  const bool fresh = s.answers == state.answers + 1 && s.new_imu;
  state.answers = s.answers;
  // landed, and the operator has acknowledged why
  const bool stands = doing == FlightState::halt || doing == FlightState::ground;
  if (stands && in.directive.cause == LandingCause::none) state.motors = {};
  spin_up(p, in, dt, state);
  state.doubt *= std::exp(-dt / p.doubt_time);
  if (!fresh) doubt_signals(p, in, state);
  std::shift_right(state.sent.begin(), state.sent.end(), 1);
  state.sent.front() = in.motors;

  const bool lands = doing == FlightState::landing && e.altitude_known;
  const double lowest = lands && state.motors.weak == Motor::none ? p.low : p.contact;
  const bool aloft = (doing == FlightState::flying || doing == FlightState::landing) && e.altitude > lowest;
  // what was sampled before a gap comes with the first answer after it, and turned for longer than a period
  const bool follows = aloft && e.rates_known && fresh && state.heard >= 2;
  state.heard = aloft && e.rates_known && fresh ? std::min(state.heard + 1, 2U) : 0;
  if (!follows) {
    state.p = s.p;
    state.q = s.q;
    state.evidence = {};
    if (!aloft) state.wind_roll = state.wind_pitch = 0;
    out.motors = state.motors;
    return;
  }
  std::array<double, 4>& effectiveness = state.motors.effectiveness;
  const auto gives = [&](std::size_t motor) { return effectiveness[motor] * state.thrusts[motor]; };
  const double each = 0.5 * p.effect, gain = -std::expm1(-p.bandwidth * dt);
  state.p += dt * (each * (gives(left) - gives(right)) - p.damping * state.p);
  state.q += dt * (each * (gives(front) - gives(rear)) - p.damping * state.q);
  const double off_p = s.p - state.p, off_q = s.q - state.q;
  state.p += gain * off_p;
  state.q += gain * off_q;
  const double part = gain / (dt * each);
  const double roll = part * off_p, pitch = part * off_q;
  const bool sound = state.motors.weak == Motor::none;
  if (sound) find_weak(p, roll, pitch, dt, state);
  if (state.motors.weak != Motor::none) {
    const std::size_t i = static_cast<std::size_t>(state.motors.weak) - 1;
    const double less = lacking(roll, pitch)[i] / std::max(state.thrusts[i], 0.1);
    effectiveness[i] = std::clamp(effectiveness[i] - (sound ? 1 : p.follow * dt) * less, 0.1, 1.0);
    // what it lacks is known now
    if (sound) {
      state.p = s.p;
      state.q = s.q;
    }
  }
  out.motors = state.motors;
}

}  // namespace jarol::tasks
