#include "tasks/javiator/altitude_control.h"

#include <algorithm>
#include <cmath>

#include "graph/math/euler_angles.h"
#include "graph/math/geometry.h"
#include "tasks/add_task.h"
#include "tasks/javiator/altitude_phases.h"
#include "tasks/javiator/foot_stand.h"

namespace jarol::tasks {
namespace {

// It leans as far as its altitude has room for: the ground carries a part of it by one foot. By the pressure, which is
// noisy, one that has stood on a foot does so until it is level.
bool stands_on_foot(const AltitudeControl::Param& p, const FlightEstimate& e, bool has_stood) {
  const double lean = std::max(std::abs(e.roll), std::abs(e.pitch));
  if (lean <= p.ground.level) return false;
  if (e.altitude_known) return may_stand({p.foot, p.ground.near}, e.roll, e.pitch, e.altitude);
  return e.pressure_known && (has_stood || may_stand({p.foot, p.ground.near_by_pressure}, e.roll, e.pitch, e.altitude));
}

// sag of the battery, flow through the rotors, the ground: whatever thrust is lost or gained is felt at once
void learn_trim(const AltitudeStep& step, double felt, bool comes_down) {
  const auto& [p, e, d, dt, state, lift] = step;
  // what a foot carries is no thrust: learnt as such it would let the vehicle fall onto its other feet; but light
  // on its feet for long, wind turns it over
  const bool on_foot = comes_down && stands_on_foot(p, e, state.on_foot > 0);
  state.on_foot = on_foot ? state.on_foot + dt : comes_down ? state.on_foot : 0;
  const double learnt = on_foot ? -p.unload * state.on_foot * dt : p.lift_bandwidth * dt * (1 + state.expected - felt);
  state.trim = std::clamp(state.trim + learnt, p.limits.min_trim, p.limits.max_trim);
}

}  // namespace

void AltitudeControl::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  const FlightDirective& d = in.directive;
  const double dt = seconds(tick.period);
  const AltitudeStep step{p, e, d, dt, state, out.lift};
  if (d.state == FlightState::halt || d.state == FlightState::ground) return run_down(step);
  if (d.state == FlightState::starting) return spin_up(step);
  if (!state.lifted) return leave_ground(step);
  out.lift.stands = false;
  const bool quick = e.lean_known && e.altitude_known;
  if (!e.rates_known && !quick) return sink_blind(step);

  state.blind_trim = state.blind_cut = 0;
  // on its feet lasers do not show how it leans
  const QuickLanding& q = e.tilt_known ? p.by_sonars : p.quick;
  const bool is_low = e.tilt_known ? e.touches : e.altitude < q.contact;
  const bool touches = quick && is_low && d.state == FlightState::landing;
  if (touches)
    state.foot_cut = std::min(state.foot_cut + q.cut * dt, p.limits.max_thrust);
  else
    state.foot_cut = std::max(state.foot_cut - q.back * dt, 0.0);
  // a pilot who flies it to the ground wants it to stand there, not to hover with one foot on it
  const bool settling = settles(step), comes_down = d.state == FlightState::landing || settling;
  if (comes_down) {
    descend(step, quick ? &q : nullptr);
  } else {
    state.landing = state.on_foot = 0;
    approach(state.z, d.altitude, p.approach, dt);
  }
  const double felt = e.lift / gravity;
  if (quick) {
    // the gust that it last felt passes
    state.trim += (state.mean_trim - state.trim) * dt / (q.fade + dt);
  } else {
    learn_trim(step, felt, comes_down);
    state.aloft = std::min(state.aloft + dt, p.mean_time);
    state.mean_trim += (state.trim - state.mean_trim) * dt / state.aloft;
  }

  double& thrust = out.lift.thrust;
  const double error = state.z.place - e.altitude;
  state.sunk = limited(state.sunk + p.ki * error * dt, p.limits.sunk);
  const double kp = quick ? q.kp : p.kp, kd = quick ? q.kd : p.kd;
  const double wanted = state.z.demand + kp * error + kd * (state.z.speed - e.climb) + state.sunk;
  // where it may stand one wrong range must not throw it up again
  const double a = touches ? std::min(wanted, q.up) : wanted;
  const double upright = std::max(down_in_body(e.roll, e.pitch)[2], p.limits.min_upright);
  thrust = std::clamp(state.trim + (1 + a / gravity) / upright - 1 - state.foot_cut,
                      touches ? 0.0 : p.limits.min_thrust, p.limits.max_thrust);
  state.expected += (thrust - state.trim - state.expected) * dt / (p.lift_lag + dt);
  // it feels more than the rotors give, or is still: the ground carries
  const bool carried = thrust < p.light && felt - (state.trim + state.expected) > p.ground.carried_lift;
  // its altitude may be wrong, but the ground is felt: leaning on, the wind would turn it over
  out.lift.stands = d.state == FlightState::landing && !quick && !e.altitude_confirmed && carried;
  if (settling && (carried || (e.altitude < p.ground.altitude && std::abs(e.climb) < p.ground.still))) {
    state.lifted = false;
    state.trim = std::max(std::min(thrust, state.trim), p.idle);
  }
}

template void add_task<AltitudeControl>(Registry&);

}  // namespace jarol::tasks
