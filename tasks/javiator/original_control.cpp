#include "tasks/javiator/original_control.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"
#include "graph/math/rotations.h"
#include "tasks/add_task.h"

namespace jarol::tasks {
namespace {

double calc_pidd(const PiddGains& g, double goal, double place, double velocity, double acceleration, PiddState& state,
                 double dt) {
  const double error = goal - place;
  state.integral = limited(state.integral + error * dt, 16000.0);
  const double goal_rate = (goal - state.goal) / dt;
  state.goal = goal;
  return g.kp * error + g.ki * state.integral + g.kd * (goal_rate - velocity) + g.kdd * acceleration;
}

// the terminal's commands are smoothed as they come, one a period
void smooth(double& value, double command) { value += 0.2 * (command - value); }

}  // namespace

void OriginalLogic::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const PilotCommand& command = in.command;
  FlightDirective& d = out.directive;
  state.unheard = command.heard ? 0 : state.unheard + seconds(tick.period);
  const bool switched = command.state_switches != state.state_switches;
  const bool shut_down = command.shut_downs != state.shut_downs;
  state.state_switches = command.state_switches;
  state.shut_downs = command.shut_downs;

  const double idle = in.gains.idle.value_or(p.idle);
  // whole periods, as it counts them
  if (shut_down || state.unheard > p.patience + 0.5 * seconds(tick.period)) {
    d = {.cause = shut_down ? LandingCause::none : LandingCause::operator_lost,
         .trim_roll = d.trim_roll,
         .trim_pitch = d.trim_pitch};
  } else if (switched) {
    d.cause = LandingCause::none;
    if (d.state == FlightState::ground) {
      d.state = FlightState::starting;
      // where rotors have not run down it flies on at once
      if (state.revs > 0) state.revs = idle;
    } else {
      d.state = FlightState::ground;
    }
  } else if (d.state == FlightState::starting && (state.revs += p.rev_step) >= idle) {
    d.state = FlightState::flying;
  } else if (d.state == FlightState::ground) {
    state.revs = std::max(state.revs - p.rev_step, 0.0);
  }
  if (d.state == FlightState::halt) state.revs = 0;
  trim(command, in.estimate, default_max_trim, state.trim, d);
  if (!command.heard) return;
  d.hold_position = command.mode_switches % 2 == 1;
  smooth(d.roll, command.roll);
  smooth(d.pitch, command.pitch);
  // the terminal's yaw goes from one side of 180 degrees to the other; the short way is meant
  smooth(d.yaw, d.yaw + wrapped(command.yaw - d.yaw));
  smooth(d.altitude, command.altitude);
  smooth(d.x, command.x);
  smooth(d.y, command.y);
}

void OriginalPosition::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  const FlightDirective& d = in.directive;
  const double dt = seconds(tick.period);
  double roll = d.roll, pitch = d.pitch;
  if (d.hold_position && d.state == FlightState::flying) {
    const PiddGains& gains = in.gains.position.value_or(p.gains);
    const double max = 1e3 * p.lean_limit;
    // near its goal it corrects seldom
    const auto hold = [&](double error, double speed, double acceleration, double& integral, std::uint32_t& waited,
                          double& lean) {
      // whole numbers, of periods and mm
      const double periods = std::floor(p.regularity / (std::floor(std::abs(error)) + 1));
      if (static_cast<double>(++waited) < periods) return;
      waited = 0;
      integral = limited(integral + error * dt, 160.0);
      const double demand = gains.kp * error + gains.ki * integral + gains.kd * speed + gains.kdd * acceleration;
      lean = limited(demand, max);
    };
    hold(1e3 * (d.y - e.y), 1e3 * e.v_y, 1e3 * e.a_y, state.integral_y, state.waited_y, state.roll);
    hold(1e3 * (d.x - e.x), 1e3 * e.v_x, 1e3 * e.a_x, state.integral_x, state.waited_x, state.pitch);
    roll = 1e-3 * state.roll;
    pitch = -1e-3 * state.pitch;
  } else {
    state = {};
  }
  // a place is meant from north, what is commanded by hand from the take-off heading, neither from the nose
  const double from = d.hold_position && d.state == FlightState::flying ? e.heading : e.yaw;
  const double c = std::cos(from), s = std::sin(from);
  out.goal = {.roll = roll * c + pitch * s, .pitch = pitch * c - roll * s, .yaw = d.yaw};
}

void OriginalAttitude::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  const double dt = seconds(tick.period);
  const Eigen::Vector3d rates = 1e3 * euler_rates(e.roll, e.pitch, {e.p, e.q, e.r});  // mrad/s
  // what it calls acceleration is less than a third of it at 15 ms
  constexpr double per_period = 19.79;
  const PiddGains& lean = in.gains.lean.value_or(p.lean);
  const double roll =
      calc_pidd(lean, 1e3 * in.goal.roll, 1e3 * e.roll, rates.x(), per_period * (rates.x() - state.p), state.roll, dt);
  const double pitch = calc_pidd(lean, 1e3 * in.goal.pitch, 1e3 * e.pitch, rates.y(),
                                 per_period * (rates.y() - state.q), state.pitch, dt);
  // turned round, a goal and its rate are those of the nearest heading that is the same
  const double goal = e.yaw + wrapped(in.goal.yaw - e.yaw);
  state.yaw.goal = 1e3 * (goal + wrapped(1e-3 * state.yaw.goal - goal));
  const double yaw = calc_pidd(in.gains.yaw.value_or(p.yaw), 1e3 * goal, 1e3 * e.yaw, rates.z(),
                               per_period * (rates.z() - state.r), state.yaw, dt);
  state.p = rates.x();
  state.q = rates.y();
  state.r = rates.z();
  out.turn = {roll / p.idle, pitch / p.idle, yaw / p.idle};
}

void OriginalAltitude::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  if (in.directive.state != FlightState::flying) {
    state = {.z = {.goal = 1e3 * in.directive.altitude}};
    out.lift.thrust = 1;
    return;
  }
  const double goal = 1e3 * in.directive.altitude;
  const double demand = calc_pidd(in.gains.altitude.value_or(p.gains), goal, 1e3 * e.altitude, 1e3 * e.climb,
                                  1e3 * e.a_up, state.z, seconds(tick.period));
  // helps it to settle
  if (goal < 10 && state.z.integral >= 0) state.z.integral -= 10;
  const double idle = in.gains.idle.value_or(p.idle);
  out.lift.thrust = (idle + demand / (std::cos(e.roll) * std::cos(e.pitch))) / p.idle;
}

void OriginalMixer::run(const Param& p, const Tick& tick, const In& in, Out& out) {
  const FlightState doing = in.directive.state;
  out.motors.number = static_cast<std::uint32_t>(tick.activation + 1);
  auto& signals = out.motors.signals;
  out.motors.unlocked = doing != FlightState::halt;
  if (doing == FlightState::halt) {
    signals = {};
  } else if (doing == FlightState::flying) {
    // front and rear turn clockwise: more of them turns the hull to the left
    const TurnDemand& t = in.turn;
    const double lift = in.lift.thrust;
    const std::array<double, 4> parts = {lift - t.yaw + t.pitch, lift + t.yaw - t.roll, lift - t.yaw - t.pitch,
                                         lift + t.yaw + t.roll};
    for (std::size_t i = 0; i < 4; ++i) signals[i] = std::clamp(p.idle * parts[i], 0.0, 16000.0);
  } else {
    const double step = doing == FlightState::starting ? p.rev_step : -p.rev_step;
    for (double& signal : signals) signal = std::clamp(signal + step, 0.0, 16000.0);
  }
}

template void add_task<OriginalAltitude>(Registry&);
template void add_task<OriginalAttitude>(Registry&);
template void add_task<OriginalLogic>(Registry&);
template void add_task<OriginalMixer>(Registry&);
template void add_task<OriginalPosition>(Registry&);

}  // namespace jarol::tasks
