#include "tasks/javiator/altitude_phases.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"

namespace jarol::tasks {
void run_down(const AltitudeStep& step) {
  const auto& [p, e, d, dt, state, lift] = step;
  state = {};
  lift.stands = true;
  lift.thrust = d.state == FlightState::halt ? 0 : std::max(lift.thrust - dt / p.ground.run_down, 0.0);
}

void spin_up(const AltitudeStep& step) {
  const auto& [p, e, d, dt, state, lift] = step;
  lift.thrust = std::min(lift.thrust + p.idle * dt / p.spin_up, p.idle);
  state.trim = lift.thrust;
  lift.stands = true;
}

void leave_ground(const AltitudeStep& step) {
  const auto& [p, e, d, dt, state, lift] = step;
  const bool wants_up = d.state == FlightState::flying && d.altitude > p.ground.altitude;
  state.trim = std::clamp(state.trim + (wants_up ? p.lift_rate : -p.lift_rate) * dt, p.idle, p.ground.max_thrust);
  // what stands does not take off to land, whatever its sonar reports
  const bool lands = d.state == FlightState::landing && !lift.stands;
  // what has just left when it is to stay comes down in flight
  const bool rises = !lift.stands && e.climb > p.ground.rising;
  state.lifted = (wants_up || lands || rises) && e.altitude > p.ground.altitude;
  lift.stands = !state.lifted && state.trim <= (wants_up ? p.leaving : p.idle);
  state.z = {e.altitude, std::max(e.climb, 0.0)};
  state.expected = state.sunk = 0;
  // what lifts it is more than what carries it
  state.mean_trim = std::min(state.trim, 1.0);
  state.aloft = p.first_aloft;
  state.blind_trim = state.blind_cut = state.foot_cut = 0;
  lift.thrust = state.trim;
}

void sink_blind(const AltitudeStep& step) {
  const auto& [p, e, d, dt, state, lift] = step;
  const BlindSinking& b = p.blind;
  const bool measured = e.altitude_known && e.answers_known;
  const double excess = -b.speed - e.climb;  // of its descent
  state.foot_cut = 0;
  // where it is lost in the climb that thrust is half learnt
  state.blind_trim =
      measured ? limited(state.blind_trim + b.ki * excess * dt, b.max_trim) : std::min(state.blind_trim, 0.0);
  // near the ground it would stay light
  const double blindly = state.blind_cut < b.cut_when_landed ? b.unmeasured_cut : b.landed_cut;
  const double cut = !measured ? blindly : e.altitude < p.ground.altitude ? b.ground_cut : 0.0;
  state.blind_cut = std::min(state.blind_cut + cut * dt, b.max_cut);
  const double correction = std::clamp(b.gain * excess, measured ? -b.max_less : -b.max_less_unmeasured, b.max_more);
  lift.thrust = std::max(state.mean_trim - b.margin + state.blind_trim - state.blind_cut + correction, 0.0);
}

bool settles(const AltitudeStep& step) {
  const auto& [p, e, d, dt, state, lift] = step;
  return d.state == FlightState::flying && d.altitude <= p.ground.altitude && e.altitude < p.low;
}

void descend(const AltitudeStep& step, const QuickLanding* quick) {
  const auto& [p, e, d, dt, state, lift] = step;
  state.landing += dt;
  const double overdue = std::clamp(p.overdue * (state.landing - p.landing_time), 0.0, p.touch_speed);
  // an altitude that nothing confirms may be wrong
  const bool is_high = e.altitude > p.high && e.altitude_confirmed;
  if (quick != nullptr) {
    const QuickLanding& q = *quick;
    const double way = std::max(e.altitude - q.low, 0.0);
    const double fast = std::min(q.descent, std::sqrt(q.touch_speed * q.touch_speed + 2 * q.brake * way));
    // a helicopter that still flies to the side would trip over its feet
    const double part = std::clamp(2 - std::hypot(e.v_x, e.v_y) / q.drift, 0.0, 1.0);
    const double speed = std::max(part * fast, q.touch_speed);
    state.z.demand = limited(q.gain * (-speed - state.z.speed), q.acceleration);
  } else {
    const double speed = is_high ? p.descent : p.touch_speed + overdue;
    state.z.demand = limited(p.descent_gain * (-speed - state.z.speed), p.max_descent_change);
  }
  state.z.speed += state.z.demand * dt;
  // never far below: on the ground it would wind down all at once
  state.z.place = std::max(state.z.place + state.z.speed * dt, e.altitude - p.max_below);
}

}  // namespace jarol::tasks
