#include "tasks/javiator/motor_watch.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"
#include "tasks/javiator/rotor_law.h"

namespace jarol::tasks {
namespace {

enum : std::size_t { front, right, rear, left };

RotorLaw law_of(const MotorWatch::Param& p) { return {p.hover, p.exponent, p.voltage}; }

// Signals turn the rotors from the second period after they were given until the next ones do; what is measured then
// comes with the answer to these.
void spin_up(const MotorWatch::Param& p, const MotorWatch::In& in, double dt, MotorWatch::State& state) {
  const RotorLaw law = law_of(p);
  const MotorCommand& felt = state.sent.back();
  for (std::size_t i = 0; i < state.reached.size(); ++i) {
    const double before = law.thrust(state.reached[i], in.estimate.battery);
    state.reached[i] += -std::expm1(-dt / p.lag) * ((felt.unlocked ? felt.signals[i] : 0) - state.reached[i]);
    state.thrusts[i] = 0.5 * (before + law.thrust(state.reached[i], in.estimate.battery));
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
  if (doing == FlightState::starting) state.motors = {};
  spin_up(p, in, dt, state);
  state.doubt *= std::exp(-dt / p.doubt_time);
  if (!fresh) doubt_signals(p, in, state);
  std::shift_right(state.sent.begin(), state.sent.end(), 1);
  state.sent.front() = in.motors;

  const bool aloft = (doing == FlightState::flying || doing == FlightState::landing) && e.altitude > p.contact;
  if (!aloft || !e.rates_known || !fresh || !state.looks) {
    state.looks = aloft && e.rates_known && fresh;
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
