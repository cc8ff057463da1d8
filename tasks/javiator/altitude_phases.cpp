#include "tasks/javiator/altitude_phases.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"

namespace jarol::tasks {
namespace {

// thrust is in parts of that of hover
constexpr double run_down_time = 1.0;  // s, from the thrust of hover to none
constexpr double max_leaving = 1.5;    // thrust, with which it tries to leave the ground
constexpr double rising = 0.1;         // m/s, of climb, from which on it flies
constexpr double first_aloft = 0.4;    // s, for which the first thrust counts in the mean of what carries it

// blind
constexpr double max_blind_trim = 0.2;
constexpr double blind_margin = 0.03;              // of thrust: it sinks, and does not rise
constexpr double max_less = 0.2, max_more = 0.06;  // of thrust, by a climb that is measured
constexpr double max_less_unmeasured = 0.06;       // by one that is not
constexpr double ground_cut = 2.0;                 // 1/s, where the sonar shows the ground
// where nobody measures the altitude it has come down after ten seconds, and may lie there
constexpr double unmeasured_cut = 0.005, landed_cut = 0.1;  // 1/s, before and after that
constexpr double cut_when_landed = 0.05;                    // thrust, taken back until then
constexpr double max_cut = 2.0;                             // thrust

// landing
constexpr double low = 0.15;                         // m, below which it settles by hand
constexpr double high = 0.5;                         // m, above which it descends fast
constexpr double max_below = 0.15;                   // m, of what is followed below the vehicle
constexpr double descent_gain = 3, quick_gain = 10;  // 1/s, acceleration per error of speed
constexpr double max_descent_change = 2;             // m/s^2

}  // namespace

void run_down(const AltitudeStep& step) {
  const auto& [p, e, d, dt, state, lift] = step;
  state = {};
  lift.stands = true;
  lift.thrust = d.state == FlightState::halt ? 0 : std::max(lift.thrust - dt / run_down_time, 0.0);
}

void spin_up(const AltitudeStep& step) {
  const auto& [p, e, d, dt, state, lift] = step;
  lift.thrust = std::min(lift.thrust + p.idle * dt / p.spin_up, p.idle);
  state.trim = lift.thrust;
  lift.stands = true;
}

void leave_ground(const AltitudeStep& step) {
  const auto& [p, e, d, dt, state, lift] = step;
  const bool wants_up = d.state == FlightState::flying && d.altitude > on_ground;
  state.trim = std::clamp(state.trim + (wants_up ? p.lift_rate : -p.lift_rate) * dt, p.idle, max_leaving);
  // what stands does not take off to land, whatever its sonar reports
  const bool lands = d.state == FlightState::landing && !lift.stands;
  // what has just left when it is to stay comes down in flight
  const bool rises = !lift.stands && e.climb > rising;
  state.lifted = (wants_up || lands || rises) && e.altitude > on_ground;
  lift.stands = !state.lifted && state.trim <= (wants_up ? p.leaving : p.idle);
  state.z = {e.altitude, std::max(e.climb, 0.0)};
  state.expected = state.sunk = 0;
  // what lifts it is more than what carries it
  state.mean_trim = std::min(state.trim, 1.0);
  state.aloft = first_aloft;
  state.blind_trim = state.blind_cut = 0;
  lift.thrust = state.trim;
}

void sink_blind(const AltitudeStep& step) {
  const auto& [p, e, d, dt, state, lift] = step;
  const bool measured = e.altitude_known && e.answers_known;
  const double excess = -p.blind_speed - e.climb;  // of its descent
  // where it is lost in the climb that thrust is half learnt
  state.blind_trim =
      measured ? limited(state.blind_trim + p.blind_ki * excess * dt, max_blind_trim) : std::min(state.blind_trim, 0.0);
  // near the ground it would stay light
  const double blindly = state.blind_cut < cut_when_landed ? unmeasured_cut : landed_cut;
  const double cut = !measured ? blindly : e.altitude < on_ground ? ground_cut : 0.0;
  state.blind_cut = std::min(state.blind_cut + cut * dt, max_cut);
  const double correction = std::clamp(p.blind_gain * excess, measured ? -max_less : -max_less_unmeasured, max_more);
  lift.thrust = std::max(state.mean_trim - blind_margin + state.blind_trim - state.blind_cut + correction, 0.0);
}

bool settles(const AltitudeStep& step) {
  const auto& [p, e, d, dt, state, lift] = step;
  return d.state == FlightState::flying && d.altitude <= on_ground && e.altitude < low;
}

void descend(const AltitudeStep& step, bool quick) {
  const auto& [p, e, d, dt, state, lift] = step;
  state.landing += dt;
  const double overdue = std::clamp(p.overdue * (state.landing - p.landing_time), 0.0, p.touch_speed);
  // an altitude that nothing confirms may be wrong
  const bool is_high = e.altitude > high && e.altitude_known && e.pressure_known;
  if (quick) {
    const QuickLanding& q = p.quick;
    const double way = std::max(e.altitude - q.low, 0.0);
    const double fast = std::min(q.descent, std::sqrt(q.touch_speed * q.touch_speed + 2 * q.brake * way));
    // a helicopter that still flies to the side would trip over its feet
    const double part = std::clamp(2 - std::hypot(e.v_x, e.v_y) / q.drift, 0.0, 1.0);
    const double speed = std::max(part * fast, q.touch_speed);
    state.z.demand = limited(quick_gain * (-speed - state.z.speed), q.acceleration);
  } else {
    const double speed = is_high ? p.descent : p.touch_speed + overdue;
    state.z.demand = limited(descent_gain * (-speed - state.z.speed), max_descent_change);
  }
  state.z.speed += state.z.demand * dt;
  // never far below: on the ground it would wind down all at once
  state.z.place = std::max(state.z.place + state.z.speed * dt, e.altitude - max_below);
}

}  // namespace jarol::tasks
