#include "tasks/javiator/flight_logic.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "graph/math/geometry.h"
#include "tasks/add_task.h"

namespace jarol::tasks {
namespace {

using Cause = LandingCause;

Cause find_lean(const FlightLogic::Param& p, const FlightEstimate& e) {
  if (std::abs(e.roll) > p.roll_limit) return Cause::roll;
  return std::abs(e.pitch) > p.pitch_limit ? Cause::pitch : Cause::none;
}

// Angles that nobody has measured lately may have gone anywhere.
bool measures_lean(const FlightEstimate& e) { return e.attitude_known && e.rates_known; }

// Out of control, on its side or its back, where rotors do nothing but harm.
bool lies_over(const FlightLogic::Param& p, const FlightEstimate& e) {
  return (e.rates_known || e.lean_known) &&
         std::cos(e.roll) * std::cos(e.pitch) < std::cos(measures_lean(e) ? p.out_of_control : p.overturned);
}

// Once it descends, only the ground can stop it or take its weight.
bool has_touched(const FlightLogic::Param& p, const FlightEstimate& e, double thrust) {
  const bool still = e.altitude_known && e.altitude < p.high && std::abs(e.climb) < p.still;
  return e.answers_known && (still || thrust < p.light);
}

// One that leans may stand on one foot, and would fall onto the others with its motors off; one with all of its thrust
// may hover for a moment. Where nobody knows, it had better end.
bool may_fall(const FlightLogic::Param& p, const FlightEstimate& e, double thrust) {
  return (e.rates_known || e.tilt_known) && (std::hypot(e.roll, e.pitch) > p.level || thrust > p.carried);
}

// For how long that has to last. A motor that gives more than it is commanded carries it aloft with little thrust
// demanded.
double touch_time(const FlightLogic::Param& p, const FlightEstimate& e, double thrust) {
  if (e.altitude_known && e.altitude >= p.high) return p.high_time;
  // an updraft may hold it up with little thrust, or nearly still: where its sonars show no foot on the ground that it
  // left it takes both, as on ground that is higher
  const bool no_foot_stands = e.tilt_known && !e.touches;
  if (no_foot_stands && !(thrust < p.light && std::abs(e.climb) < p.still)) return p.high_time;
  return no_foot_stands || may_fall(p, e, thrust) ? p.doubt_time : p.touch_time;
}

// Its rotors give what they can, and it does not rise.
bool lacks_lift(const FlightLogic::Param& p, const FlightLogic::In& in, const FlightDirective& d) {
  const FlightEstimate& e = in.estimate;
  return in.lift.thrust > p.full && e.altitude < d.altitude - p.too_low && e.climb < p.no_climb;
}

// Why it can't go on flying as it is commanded, if so.
Cause find_cause(const FlightLogic::Param& p, const FlightLogic::In& in, bool wants_position, double unheard) {
  const FlightEstimate& e = in.estimate;
  if (in.motors.weak != Motor::none) return Cause::motor_weak;
  if (const Cause lean = find_lean(p, e); lean != Cause::none) return lean;
  if (std::abs(wrapped(e.yaw)) > p.yaw_limit) return Cause::yaw;
  if (e.altitude > p.altitude_limit) return Cause::altitude;
  if (unheard > p.patience) return Cause::operator_lost;
  if (!e.answers_known) return Cause::answers_late;
  if (!e.attitude_known) return Cause::imu_lost;
  if (!e.altitude_known) return Cause::sonar_lost;
  if (!e.pressure_known) return Cause::bmu_lost;
  if (e.battery == 0) return Cause::bmu_lost;  // which measures it, and never has
  if (e.battery < p.battery_limit) return Cause::battery_low;
  if (wants_position && !e.position_known) return Cause::position_lost;
  return Cause::none;
}

void enter(FlightState next, Cause cause, FlightLogic::State& state, FlightDirective& d) {
  d.state = next;
  d.cause = cause;
  state.since = state.still = state.lies_over = state.without_lift = 0;
  state.settles = false;
}

// Where it comes to rest; but in a turn, or where its lasers have not seen enough, along the walls that it can see.
double find_yaw(const FlightLogic::Param& p, Cause cause, const FlightEstimate& e, bool wants_position) {
  constexpr double quarter = 0.5 * std::numbers::pi;
  if (!wants_position || cause == Cause::motor_weak || (e.altitude_known && e.altitude < p.low)) return e.yaw;
  if (cause != Cause::position_lost && std::abs(e.r) < p.turning.rate) return e.yaw;
  const double heading = e.heading + p.turning.stop_time * e.r;
  return e.yaw + quarter * std::round(heading / quarter) - e.heading;
}

// Straight down from where it can stop.
void stay_here(const FlightLogic::Param& p, const FlightEstimate& e, FlightDirective& d) {
  d.roll = d.pitch = 0;
  d.x = e.x + p.way.stop_time * e.v_x;
  d.y = e.y + p.way.stop_time * e.v_y;
}

void begin_landing(const FlightLogic::Param& p, Cause cause, const FlightEstimate& e, FlightLogic::State& state,
                   FlightDirective& d) {
  enter(FlightState::landing, cause, state, d);
  stay_here(p, e, d);
  d.yaw = find_yaw(p, cause, e, d.hold_position);
  d.altitude = 0;
}

void see_wall(const PlaceFix& fix, Walls& walls) {
  if (fix.is_new) (fix.range > 0 ? walls.ahead : walls.behind) = fix.place + fix.range;
}

// No nearer than half of its span and what it overshoots, but for where it took off.
double before_walls(double place, const Walls& walls, double margin) {
  return std::clamp(place, std::min(walls.behind + margin, 0.0), std::max(walls.ahead - margin, 0.0));
}

void follow(const FlightLogic::Param& p, const PilotCommand& command, const FlightEstimate& e, bool wants_position,
            FlightLogic::State& state, FlightDirective& d) {
  d.hold_position = wants_position;
  d.yaw = command.yaw;
  d.altitude = std::max(command.altitude, 0.0);
  // sent to the ground it comes down where it is, wherever else it is sent
  const bool to_ground = command.altitude <= p.on_ground;
  const bool settles = wants_position && to_ground && !d.stands && e.altitude_known && e.altitude < p.low;
  if (settles && !state.settles) stay_here(p, e, d);
  state.settles = settles;
  if (settles) return;
  d.roll = command.roll;
  d.pitch = command.pitch;
  d.x = before_walls(command.x, state.walls_x, p.way.wall_margin);
  d.y = before_walls(command.y, state.walls_y, p.way.wall_margin);
  const bool is_far = !to_ground && std::hypot(d.x - e.x, d.y - e.y) > p.way.far;
  if (wants_position && !d.stands && (is_far || std::hypot(e.v_x, e.v_y) > p.way.fast))
    d.altitude = std::max(d.altitude, p.low);
}

// the operator's keys: unlock, take off, land
void press_switch(const FlightLogic::Param& p, const FlightEstimate& e, FlightLogic::State& state, FlightDirective& d) {
  switch (d.state) {
    case FlightState::halt: enter(FlightState::ground, Cause::none, state, d); break;
    case FlightState::ground:
      // after a landing that nobody wanted the key may have been meant to land: it only acknowledges
      enter(d.cause == Cause::none ? FlightState::starting : FlightState::ground, Cause::none, state, d);
      state.walls_x = state.walls_y = {};  // places are counted from here
      break;
    case FlightState::starting: enter(FlightState::ground, Cause::none, state, d); break;
    case FlightState::flying: begin_landing(p, Cause::none, e, state, d); break;
    case FlightState::landing: break;
  }
}

}  // namespace

void FlightLogic::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  const PilotCommand& command = in.command;
  FlightDirective& d = out.directive;
  const double dt = seconds(tick.period);
  state.since += dt;
  state.unheard = command.heard ? 0 : state.unheard + dt;
  // nobody looked during activations that were left out
  const std::int64_t before = std::exchange(state.before, tick.activation);
  const double passed = before < 0 ? dt : dt * static_cast<double>(tick.activation - before);
  const bool is_heard_again = e.answers_known && state.unanswered > p.long_silence;
  state.unanswered = e.answers_known && passed < p.answers_patience ? 0 : state.unanswered + passed;
  see_wall(e.fixes[0], state.walls_x);
  see_wall(e.fixes[1], state.walls_y);
  const bool wants_position = command.mode_switches % 2 == 1;

  if (command.shut_downs != state.shut_downs) {
    enter(FlightState::halt, Cause::none, state, d);
  } else if (command.state_switches != state.state_switches && passed < p.answers_patience) {
    press_switch(p, e, state, d);
  }
  state.shut_downs = command.shut_downs;
  state.state_switches = command.state_switches;
  trim(command, e, p.max_trim, state.trim, d);

  if (d.state == FlightState::starting) {
    const Cause cause = find_cause(p, in, wants_position, state.unheard);
    if (cause != Cause::none) {
      enter(FlightState::ground, cause, state, d);
    } else if (state.since >= p.spin_up) {
      enter(FlightState::flying, Cause::none, state, d);
    }
  }
  if (d.state == FlightState::flying) {
    state.without_lift = lacks_lift(p, in, d) ? state.without_lift + dt : 0;
    Cause cause = find_cause(p, in, wants_position, state.unheard);
    if (cause == Cause::none && state.without_lift > p.lift_patience) cause = Cause::no_lift;
    const bool leans = cause == Cause::roll || cause == Cause::pitch;
    if (leans && measures_lean(e) && e.altitude_known && e.altitude < p.tips_below) {
      // it goes on over its feet, and thrust would only throw it
      enter(FlightState::halt, cause, state, d);
    } else if (cause != Cause::none) {
      begin_landing(p, cause, e, state, d);
    } else {
      follow(p, command, e, wants_position, state, d);
    }
  }
  if (d.state == FlightState::landing) {
    d.hold_position = e.position_known;
    // what fails only now is reported, too; that nobody is heard any more is nothing then
    if (d.cause == Cause::none || d.cause == Cause::operator_lost)
      if (const Cause cause = find_cause(p, in, wants_position, 0); cause != Cause::none) {
        d.cause = cause;
        if (cause == Cause::position_lost) d.yaw = find_yaw(p, cause, e, wants_position);
      }
    const double counted = dt * p.touch_time / touch_time(p, e, in.lift.thrust);
    state.still = has_touched(p, e, in.lift.thrust) ? state.still + counted : 0;
    state.lies_over = lies_over(p, e) ? state.lies_over + dt : 0;
    // out of control it is better on the ground here than somewhere else; a lean without an IMU may be another
    if (state.lies_over > (measures_lean(e) ? p.out_of_control_time : p.touch_time))
      enter(FlightState::halt, d.cause, state, d);
    else if (state.since > p.least_time && state.still > p.touch_time)
      enter(FlightState::ground, d.cause, state, d);
  }
  const bool flies = d.state != FlightState::halt && d.state != FlightState::ground;
  const bool is_low = e.altitude_known && e.altitude < p.tips_below;
  const bool has_come_down = state.unanswered > p.answers_patience || (is_heard_again && is_low);
  // on its feet or not: nobody but the operator may start its motors again
  if (flies && has_come_down)
    enter(FlightState::halt, d.cause == Cause::none ? Cause::answers_late : d.cause, state, d);
  d.stands = in.lift.stands;
  // one that lies on its side does not stand there well, however it came to that
  if (d.state == FlightState::ground && d.cause == Cause::none && e.attitude_known) d.cause = find_lean(p, e);
}

template void add_task<FlightLogic>(Registry&);

}  // namespace jarol::tasks
