#include "tasks/lauv/fins.h"

#include <algorithm>
#include <cmath>

#include "tasks/add_task.h"
#include "tasks/lauv/control.h"

namespace jarol::tasks {
namespace {

// From when one has reported each that is fitted has its time.
bool is_any_heard(const Servos& servos) {
  return std::any_of(servos.fins.begin(), servos.fins.end(), [](const ServoReading& servo) { return servo.count > 0; });
}

void look(const FinWatch::Param& p, std::size_t i, const ServoReading& servo, double dt, FinWatch::State& state) {
  FinState& fin = state.fins.states[i];
  if (servo.count < 0 || fin == FinState::stuck) return;
  const bool fresh = servo.count > state.counts[i], first = fresh && state.counts[i] == 0;
  state.counts[i] = servo.count;
  state.silences[i] = fresh ? 0 : state.silences[i] + dt;
  if (state.silences[i] > p.silence) fin = FinState::silent;
  if (!fresh) return;
  const double commanded = limited(servo.commanded, max_fin_angle);
  double& expected = state.expected[i];
  if (first) expected = servo.angle;
  fin = FinState::follows;
  expected += limited(commanded - expected, p.servo_rate * dt);
  const bool wrong =
      servo.angle < std::min(expected, commanded) - p.error || servo.angle > std::max(expected, commanded) + p.error;
  state.wrong_for[i] = wrong ? state.wrong_for[i] + dt : std::max(state.wrong_for[i] - dt, 0.0);
  if (state.wrong_for[i] <= p.error_time) return;
  fin = FinState::stuck;
  state.fins.angles[i] = servo.angle;
}

void look(const FinWatch::Param& p, const PropellerReading& propeller, double dt, FinWatch::State& state) {
  FinState& found = state.fins.propeller;
  state.propeller_silence += dt;
  if (propeller.count <= state.propeller_count || found == FinState::stuck) return;
  const double since = state.propeller_count < 1 ? 0 : std::min(state.propeller_silence, p.silence);
  state.propeller_count = propeller.count;
  state.propeller_silence = 0;
  const double turns = propeller.speed / p.full_speed;
  const auto [slowest, fastest] = std::minmax(propeller.commanded, state.propeller_commanded);
  const bool wrong = turns < slowest - p.propeller_error || turns > fastest + p.propeller_error;
  state.propeller_commanded = propeller.commanded;
  state.propeller_wrong_for =
      wrong ? state.propeller_wrong_for + since : std::max(state.propeller_wrong_for - since, 0.0);
  found = state.propeller_wrong_for > p.propeller_time ? FinState::stuck : FinState::follows;
}

struct Pair {
  std::size_t first, second;
};
constexpr Pair rudders{0, 3}, elevators{1, 2};
// roll to starboard by a positive angle: the lift of 0 and 3 is to starboard, below and above the axis; that of 1 and 2
// is upwards, to port and to starboard of it
constexpr std::array<double, 4> roll_sides{-1, 1, -1, 1};

}  // namespace

void FinWatch::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  if (in.contact.stops != state.stops) state = State{.stops = in.contact.stops};
  if (is_any_heard(in.servos))
    for (std::size_t i = 0; i < in.servos.fins.size(); ++i) look(p, i, in.servos.fins[i], seconds(tick.period), state);
  look(p, in.servos.propeller, seconds(tick.period), state);
  out.fins = state.fins;
}

void FaultTolerantAllocator::run(const Param& p, const Tick& tick, const In& in, Out& out) {
  FinAllocator::Out sound;
  FinAllocator::run(tick, {in.pitch, in.yaw, in.thrust}, sound);
  out.actuation = sound.actuation;
  std::array<double, 4>& fins = out.actuation.fins;
  const auto stuck = [&](std::size_t i) { return in.fins.states[i] == FinState::stuck; };
  const auto all_sound = [&](const Pair& pair) { return !stuck(pair.first) && !stuck(pair.second); };
  if (all_sound(rudders) && all_sound(elevators)) return;

  // the mean of a pair is to be what was demanded of each; where nothing can take over, both are sent what was demanded
  const auto replace = [&](std::size_t i, std::size_t other) {
    if (!stuck(i) || stuck(other)) return;
    fins[other] = limited(2 * fins[other] - limited(in.fins.angles[i], p.limit), p.limit);
    fins[i] = in.fins.angles[i];
  };
  for (const Pair& pair : {rudders, elevators}) {
    replace(pair.first, pair.second);
    replace(pair.second, pair.first);
  }
  // two that part leave the pair's mean as it is, and roll
  double roll = 0;
  for (std::size_t i = 0; i < fins.size(); ++i)
    roll += roll_sides[i] * limited(stuck(i) ? in.fins.angles[i] : fins[i], p.limit);
  for (const Pair& pair : {rudders, elevators}) {
    if (!all_sound(pair)) continue;
    const double room = std::max(p.limit - std::abs(fins[pair.first]), 0.0);
    const double apart = limited(roll / 2, room);
    fins[pair.first] -= roll_sides[pair.first] * apart;
    fins[pair.second] -= roll_sides[pair.second] * apart;
  }
}

template void add_task<FaultTolerantAllocator>(Registry&);
template void add_task<FinWatch>(Registry&);

}  // namespace jarol::tasks
