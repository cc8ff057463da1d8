#include "tasks/javiator/motor_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "graph/math/geometry.h"
#include "tasks/add_task.h"
#include "tasks/javiator/rotor_law.h"

namespace jarol::tasks {
namespace {

enum : std::size_t { front, right, rear, left };

RotorLaw law_of(const MotorWatch::Param& p) { return {p.hover, p.exponent, p.voltage, p.battery}; }

// How the rotors turned it from one sample to another.
struct Turned {
  double time = 0;                  // s
  std::array<double, 4> thrusts{};  // of hover, in the mean
  std::array<double, 4> doubts{};   // by how much these may be off
};

// Follows signals for some time; the mean thrusts in it, times it.
std::array<double, 4> follow(const MotorWatch::Param& p, double battery, double time, MotorWatch::Rotors& rotors) {
  const RotorLaw law = law_of(p);
  const double part = -std::expm1(-time / p.lag);
  std::array<double, 4> impulses{};
  for (std::size_t i = 0; i < impulses.size(); ++i) {
    rotors.reached[i] += part * (rotors.signals[i] - rotors.reached[i]);
    const double before = std::exchange(rotors.now[i], law.thrust(rotors.reached[i], battery));
    impulses[i] = 0.5 * time * (before + rotors.now[i]);
  }
  return impulses;
}

// From the sample after the signals that acted last to the one after those of the number `until`: the IMU is sampled
// `sample_time` after signals act.
Turned spin_up(const MotorWatch::Param& p, double battery, double dt, std::uint32_t until, MotorWatch::State& state) {
  const double late = std::min(p.sample_time, dt), early = dt - late;
  std::array<std::array<double, 4>, 2> impulses{};
  Turned turned;
  // where all is answered both guesses are one
  bool agree = state.rotors[0] == state.rotors[1];
  while (state.acted != until) {
    const MotorWatch::Sent& next = state.sent[++state.acted % MotorWatch::kept];
    // another number stands there where one was held
    const bool was_sent = next.motors.number == state.acted;
    agree = agree && (next.heard || !was_sent);
    for (std::size_t guess = 0; guess < 2; ++guess) {
      if (guess == 1 && agree) {
        state.rotors[1] = state.rotors[0];
        impulses[1] = impulses[0];
        continue;
      }
      MotorWatch::Rotors& rotors = state.rotors[guess];
      const auto add = [&](double time) {
        const std::array<double, 4> more = follow(p, battery, time, rotors);
        for (std::size_t i = 0; i < more.size(); ++i) impulses[guess][i] += more[i];
      };
      add(early);
      if (was_sent && (guess == 0 || next.heard)) rotors.signals = next.motors.signals;
      add(late);
    }
    turned.time += dt;
  }
  for (std::size_t i = 0; i < turned.thrusts.size(); ++i) {
    turned.thrusts[i] = 0.5 * (impulses[0][i] + impulses[1][i]) / turned.time;
    turned.doubts[i] = 0.5 * std::abs(impulses[0][i] - impulses[1][i]) / turned.time;
  }
  return turned;
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
void find_weak(const MotorWatch::Param& p, double roll, double pitch, double time, MotorWatch::State& state) {
  const std::array<double, 4> lacks = lacking(roll - state.wind_roll, pitch - state.wind_pitch);
  for (std::size_t i = 0; i < lacks.size(); ++i) {
    const double across = std::abs(lacks[(i + 1) % lacks.size()]);
    // one sample is not enough: signals that were held up on their way act late, which nothing shows
    const double more = (lacks[i] - across - state.doubt - p.allowance) * time;
    state.evidence[i] = std::max(state.evidence[i] + std::min(more, p.of_one_sample * p.evidence), 0.0);
    if (state.evidence[i] > p.evidence) state.motors.weak = static_cast<Motor>(i + 1);
  }
  const double part = std::min(time / p.wind_time, 1.0);
  state.wind_roll = limited(state.wind_roll + part * (roll - state.wind_roll), p.wind);
  state.wind_pitch = limited(state.wind_pitch + part * (pitch - state.wind_pitch), p.wind);
}

// After which signals the IMU was sampled: one of these.
struct Sampled {
  std::uint32_t first = 0, last = 0;
};

// Takes in what has been answered since. The sample comes with the answer to the signals that were heard next: those
// that follow, unless some in between were not heard, or heard twice. (One that is lost and another that comes twice at
// once look like two; one sample is not enough to find a motor weak.)
Sampled take_answer(const JaviatorSensors& s, std::uint32_t newest, MotorWatch::State& state) {
  const std::uint32_t answers = s.answers - state.answers, before = state.answered;
  if (answers == 0) return {};
  state.answers = s.answers;
  state.answered = s.answered;
  if (s.answered <= before || s.answered - before >= MotorWatch::kept || newest - s.answered >= MotorWatch::kept)
    return {};
  const std::uint32_t numbers = s.answered - before;
  const bool all = answers >= numbers;
  for (std::uint32_t number = all ? before + 1 : s.answered; number <= s.answered; ++number) {
    MotorWatch::Sent& sent = state.sent[number % MotorWatch::kept];
    sent.heard = sent.motors.number == number;
  }
  if (!s.new_imu || before == 0) return {};
  return {all ? s.answered - 1 : before + answers - 1, answers <= numbers ? s.answered - 1 : s.answered};
}

// What the sample shows, if it was taken after the signals of that number.
void observe(const MotorWatch::Param& p, const MotorWatch::In& in, double dt, std::uint32_t number,
             MotorWatch::State& state) {
  const JaviatorSensors& s = in.sensors;
  const Turned turned = spin_up(p, in.estimate.battery, dt, number, state);
  std::array<double, 4>& effectiveness = state.motors.effectiveness;
  const auto gives = [&](std::size_t motor) { return effectiveness[motor] * turned.thrusts[motor]; };
  const double time = turned.time;
  const double each = 0.5 * p.effect, gain = -std::expm1(-p.bandwidth * time);
  state.p += time * (each * (gives(left) - gives(right)) - p.damping * state.p);
  state.q += time * (each * (gives(front) - gives(rear)) - p.damping * state.q);
  const double off_p = s.p - state.p, off_q = s.q - state.q;
  state.p += gain * off_p;
  state.q += gain * off_q;
  // of what was expected wrongly before, the observer has not forgotten all
  const std::array<double, 4>& d = turned.doubts;
  state.doubt = (1 - gain) * state.doubt + std::max(d[front] + d[rear], d[right] + d[left]);
  const double part = gain / (time * each);
  const double roll = part * off_p, pitch = part * off_q;
  const bool sound = state.motors.weak == Motor::none;
  if (sound) find_weak(p, roll, pitch, time, state);
  if (state.motors.weak == Motor::none) return;
  const std::size_t i = static_cast<std::size_t>(state.motors.weak) - 1;
  const double less = lacking(roll, pitch)[i] / std::max(turned.thrusts[i], p.min_thrust);
  effectiveness[i] =
      std::clamp(effectiveness[i] - (sound ? 1 : std::min(p.follow * time, 1.0)) * less, p.min_effectiveness, 1.0);
  if (!sound) return;
  // what it lacks is known now
  state.p = s.p;
  state.q = s.q;
}

// Where a sample may have been taken after several signals: had it been after the last of them, a motor would lack
// least, as it would have turned for longer.
void find_at_last(const MotorWatch::Param& p, const MotorWatch::In& in, double dt, std::uint32_t last,
                  MotorWatch::State& state) {
  MotorWatch::State late = state;
  observe(p, in, dt, last, late);
  if (late.motors.weak == Motor::none) return;
  state.motors = late.motors;
  state.follows = false;
}

}  // namespace

void MotorWatch::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const double dt = seconds(tick.period);
  const FlightEstimate& e = in.estimate;
  const JaviatorSensors& s = in.sensors;
  const FlightState doing = in.directive.state;
  // landed, and the operator has acknowledged why
  const bool stands = doing == FlightState::halt || doing == FlightState::ground;
  if (stands && in.directive.cause == LandingCause::none) state.motors = {};
  state.sent[in.motors.number % kept] = {in.motors, false};
  const Sampled sampled = take_answer(s, in.motors.number, state);
  const bool lands = doing == FlightState::landing, sound = state.motors.weak == Motor::none;
  const double lowest = lands && e.altitude_known && sound ? p.low : p.contact;
  const bool aloft = (doing == FlightState::flying || lands) && e.altitude > lowest;
  // where it may stand already the ground would be taken for a motor
  const bool may_stand = lands && sound && !e.altitude_confirmed;
  const bool watches = aloft && e.rates_known && !may_stand;
  if (!aloft) state.wind_roll = state.wind_pitch = 0;
  if (!watches) {
    state.follows = false;
    state.evidence = {};
  }
  // what was sent before is not kept any more
  if (in.motors.number - state.acted >= kept) {
    state.follows = false;
    state.evidence = {};
    state.acted = std::max(in.motors.number, kept) - kept + 1;
  }
  const bool is_sure = sampled.first == sampled.last;
  if (sampled.first <= state.acted) {
    // nothing new
  } else if (state.follows && is_sure) {
    observe(p, in, dt, sampled.first, state);
  } else if (state.follows && state.motors.weak == Motor::none) {
    find_at_last(p, in, dt, sampled.last, state);
  } else if (is_sure) {
    spin_up(p, e.battery, dt, sampled.first, state);
    state.follows = watches;
    state.p = s.p;
    state.q = s.q;
    state.doubt = 0;
  }
  out.motors = state.motors;
}

template void add_task<MotorWatch>(Registry&);

}  // namespace jarol::tasks
