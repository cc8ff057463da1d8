#include "tasks/javiator/altitude_control.h"

#include <algorithm>
#include <cmath>

#include "graph/math/euler_angles.h"
#include "graph/math/geometry.h"
#include "tasks/add_task.h"

namespace jarol::tasks {
namespace {

// It leans as far as its altitude has room for: the ground carries a part of it by one foot.
bool stands_on_foot(const AltitudeControl::Param& p, const FlightEstimate& e) {
  constexpr double level = 0.05, near = 0.01;  // rad, m
  const double lean = std::max(std::abs(e.roll), std::abs(e.pitch));
  return e.altitude_known && lean > level && e.altitude < p.foot * std::sin(lean) + near;
}

}  // namespace

void AltitudeControl::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  const FlightDirective& d = in.directive;
  const double dt = seconds(tick.period);
  double& thrust = out.lift.thrust;
  if (d.state == FlightState::halt || d.state == FlightState::ground) {
    state = {};
    out.lift.stands = true;
    // rotors that still turn run down
    thrust = d.state == FlightState::halt ? 0 : std::max(thrust - dt / 1.0, 0.0);
    return;
  }
  if (d.state == FlightState::starting) {
    thrust = std::min(thrust + p.idle * dt / p.spin_up, p.idle);
    state.trim = thrust;
    out.lift.stands = true;
    return;
  }

  constexpr double ground = 0.02;  // m
  if (!state.lifted) {
    // thrust grows slowly until the ground is left, and is learnt on the way
    const bool wants_up = d.state == FlightState::flying && d.altitude > ground;
    state.trim = std::clamp(state.trim + (wants_up ? p.lift_rate : -p.lift_rate) * dt, p.idle, 1.5);
    // what stands does not take off to land, whatever its sonar reports
    const bool lands = d.state == FlightState::landing && !out.lift.stands;
    // what has just left when it is to stay comes down in flight
    const bool rises = !out.lift.stands && e.climb > 0.1;
    state.lifted = (wants_up || lands || rises) && e.altitude > ground;
    out.lift.stands = !state.lifted && state.trim <= (wants_up ? p.leaving : p.idle);
    state.z = {e.altitude, std::max(e.climb, 0.0)};
    state.expected = state.sunk = 0;
    // what lifts it is more than what carries it
    state.mean_trim = std::min(state.trim, 1.0);
    state.aloft = 0.4;
    state.blind_trim = state.blind_cut = 0;
    thrust = state.trim;
    return;
  }
  out.lift.stands = false;
  const bool quick = e.lean_known && e.altitude_known;
  // blind: what carried it, corrected by the sonar's climb; where it is lost in the climb that thrust is half learnt
  if (!e.rates_known && !quick) {
    const bool measured = e.altitude_known && e.answers_known;
    const double excess = -p.blind_speed - e.climb;  // of its descent
    state.blind_trim =
        measured ? limited(state.blind_trim + p.blind_ki * excess * dt, 0.2) : std::min(state.blind_trim, 0.0);
    // near the ground it would stay light; where nobody measures it has come down after ten seconds, and may lie there
    const double blindly = state.blind_cut < 0.05 ? 0.005 : 0.1;               // per s
    const double cut = !measured ? blindly : e.altitude < ground ? 2.0 : 0.0;  // per s
    state.blind_cut = std::min(state.blind_cut + cut * dt, 2.0);
    const double correction = std::clamp(p.blind_gain * excess, measured ? -0.2 : -0.06, 0.06);
    thrust = std::max(state.mean_trim - 0.03 + state.blind_trim - state.blind_cut + correction, 0.0);
    return;
  }
  state.blind_trim = 0;
  // on its feet nothing shows how it leans
  const bool touches = quick && e.altitude < p.quick.contact && d.state == FlightState::landing;
  state.blind_cut = touches ? state.blind_cut + p.quick.cut * dt : 0;
  // a pilot who flies it to the ground wants it to stand there, not to hover with one foot on it
  constexpr double low = 0.15;  // m
  const bool settles = d.state == FlightState::flying && d.altitude <= ground && e.altitude < low;
  if (d.state == FlightState::landing || settles) {
    state.landing += dt;
    const double overdue = std::clamp(p.overdue * (state.landing - p.landing_time), 0.0, p.touch_speed);
    // an altitude that nothing confirms may be wrong
    const bool is_high = e.altitude > 0.5 && e.altitude_known && e.pressure_known;
    if (quick) {
      const QuickLanding& q = p.quick;
      const double way = std::max(e.altitude - q.low, 0.0);
      const double fast = std::min(q.descent, std::sqrt(q.touch_speed * q.touch_speed + 2 * q.brake * way));
      // who still flies to the side would trip over its feet
      const double part = std::clamp(2 - std::hypot(e.v_x, e.v_y) / q.drift, 0.0, 1.0);
      const double speed = std::max(part * fast, q.touch_speed);
      state.z.demand = limited(10 * (-speed - state.z.speed), q.acceleration);
    } else {
      const double speed = is_high ? p.descent : p.touch_speed + overdue;
      state.z.demand = limited(3 * (-speed - state.z.speed), 2);
    }
    state.z.speed += state.z.demand * dt;
    // never far below: on the ground it would wind down all at once
    state.z.place = std::max(state.z.place + state.z.speed * dt, e.altitude - 0.15);
  } else {
    state.landing = state.on_foot = 0;
    approach(state.z, d.altitude, p.approach, dt);
  }
  // sag of the battery, flow through the rotors, the ground: whatever thrust is lost or gained is felt at once
  const double felt = e.lift / gravity;
  const bool comes_down = d.state == FlightState::landing || settles;
  if (!quick) {
    // what a foot carries is no thrust: learnt as such it would let the vehicle fall onto its other feet; but light
    // on its feet for long, wind turns it over
    const bool on_foot = comes_down && stands_on_foot(p, e);
    state.on_foot = on_foot ? state.on_foot + dt : comes_down ? state.on_foot : 0;
    const double learnt =
        on_foot ? -p.unload * state.on_foot * dt : p.lift_bandwidth * dt * (1 + state.expected - felt);
    state.trim = std::clamp(state.trim + learnt, 0.4, 1.7);
  }
  state.aloft = std::min(state.aloft + dt, 1.0);
  state.mean_trim += (state.trim - state.mean_trim) * dt / state.aloft;
  const double error = state.z.place - e.altitude;
  state.sunk = limited(state.sunk + p.ki * error * dt, 1);
  const double a = state.z.demand + p.kp * error + p.kd * (state.z.speed - e.climb) + state.sunk;
  const double upright = std::max(down_in_body(e.roll, e.pitch)[2], 0.5);
  thrust = std::clamp(state.trim + (1 + a / gravity) / upright - 1 - state.blind_cut, touches ? 0.0 : 0.1, 2.0);
  state.expected += (thrust - state.trim - state.expected) * dt / (p.lift_lag + dt);
  // it feels more than the rotors give, or is still: the ground carries
  const bool carried = thrust < p.light && felt - (state.trim + state.expected) > 0.25;
  if (settles && (carried || (e.altitude < ground && std::abs(e.climb) < 0.05))) {
    state.lifted = false;
    state.trim = std::max(std::min(thrust, state.trim), p.idle);
  }
}

template void add_task<AltitudeControl>(Registry&);

}  // namespace jarol::tasks
