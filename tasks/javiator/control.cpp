#include "tasks/javiator/control.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"
#include "tasks/add_task.h"

namespace jarol::tasks {
namespace {

// Of the lean that holds its place, near the ground.
double lean_part(const BlindTouch& p, double altitude) {
  const double up = std::clamp((altitude - p.low) / p.over, 0.0, 1.0);
  return p.lean + (1 - p.lean) * up;
}

struct Held {
  double place, speed, drag;
};

struct HoldGains {
  double kp, kd;
};

HoldGains gains_of(const PositionControl::Param& p, const FlightEstimate& e) {
  if (e.tilt_known) return {p.by_sonars.kp, p.by_sonars.kd};
  if (e.lean_known) return {p.blind_kp, p.blind_kd};
  return {p.kp, p.kd};
}

double hold(const PositionControl::Param& p, const HoldGains& gains, const Approach& a, const Held& is, double& trim,
            double dt) {
  trim = limited(trim + p.ki * (a.place - is.place) * dt, p.max_trim);
  const auto [kp, kd] = gains;
  return a.demand + kp * (a.place - is.place) + kd * (a.speed - is.speed) - is.drag + trim;
}

double turn(const TurnGains& g, TurnModel& model, double goal, double angle, double rate, double dt) {
  const double w = g.bandwidth;
  const double max = g.model_part * g.limit * g.effect;
  const double speed = limited(0.5 * w * (goal - model.angle), g.rate);
  const double acceleration = limited(2 * w * (speed - model.rate), max);
  model.angle += model.rate * dt + 0.5 * acceleration * dt * dt;
  model.rate += acceleration * dt;
  const double error = wrapped(model.angle - angle);
  model.trim = limited(model.trim + g.ki * error * dt, g.trim_part * g.limit);
  const double demand =
      limited(acceleration / g.effect + g.kp * error + g.kd * (model.rate - rate) + model.trim, g.limit);
  // a zero at 1/spin_time is cancelled
  model.given += (demand - model.given) * dt / (g.spin_time + dt);
  return model.given;
}

// By as much as a motor's part exceeds what it can give its pair gets less, and the other pair more: that turns yaw
// alone.
void spare(std::array<double, 4>& parts, const std::array<double, 4>& effectiveness, double full) {
  const auto excess = [&](std::size_t i) { return std::max(parts[i] - effectiveness[i] * full, 0.0); };
  const double less = std::max(excess(0), excess(2)) - std::max(excess(1), excess(3));
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i] += i % 2 == 0 ? -less : less;
}

}  // namespace

void PositionControl::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  const FlightDirective& d = in.directive;
  const double dt = seconds(tick.period);
  const double c = std::cos(e.heading), s = std::sin(e.heading);
  out.goal.yaw = d.yaw;
  state.drag_x += (e.drag_x - state.drag_x) * dt / (p.drag_time + dt);
  state.drag_y += (e.drag_y - state.drag_y) * dt / (p.drag_time + dt);
  // to the right by rolling right, forward by nosing down
  const auto lean = [&](double a_x, double a_y) {
    out.goal.roll = limited(std::atan((c * a_y - s * a_x) / gravity), p.lean_limit);
    out.goal.pitch = limited(-std::atan((c * a_x + s * a_y) / gravity), p.lean_limit);
  };

  const auto level = [&](double time) {
    out.goal.roll -= out.goal.roll * dt / time;
    out.goal.pitch -= out.goal.pitch * dt / time;
  };

  // level where it stands, not so fast that its feet slap
  if (d.stands) {
    state.holding = false;
    level(p.stand_time);
    out.goal.yaw = e.yaw;
    return;
  }
  // the ground moves it now, and what is known of its place and speed is worth little
  if (d.state == FlightState::landing && e.touches) return level(p.by_sonars.level_time);
  // landing without a place it brakes by what it still knows of its speed
  if (d.state == FlightState::landing && !d.hold_position) {
    state.holding = false;
    lean(-e.v_x - state.drag_x, -e.v_y - state.drag_y);
    return;
  }
  // by hand; commands are meant from the take-off heading, not from the nose
  if (!d.hold_position || d.state == FlightState::starting || d.state == FlightState::ground) {
    state.holding = false;
    const double cos_yaw = std::cos(e.yaw), sin_yaw = std::sin(e.yaw);
    out.goal.roll = limited(d.pitch * sin_yaw + d.roll * cos_yaw, p.lean_limit);
    out.goal.pitch = limited(d.pitch * cos_yaw - d.roll * sin_yaw, p.lean_limit);
    return;
  }
  if (!state.holding)
    state = {.x = {e.x, e.v_x},
             .y = {e.y, e.v_y},
             .drag_x = e.drag_x,
             .drag_y = e.drag_y,
             .trim_x = state.trim_x,
             .trim_y = state.trim_y};
  state.holding = true;
  approach(state.x, d.x, p.approach, dt);
  approach(state.y, d.y, p.approach, dt);
  const HoldGains gains = gains_of(p, e);
  // levelling before the touch then lets the wind stop it, and does not drive it over its feet
  const double upwind = e.tilt_known && d.state == FlightState::landing ? p.by_sonars.upwind : 0;
  const double a_x = hold(p, gains, state.x, {e.x, e.v_x + upwind * state.drag_x, state.drag_x}, state.trim_x, dt);
  const double a_y = hold(p, gains, state.y, {e.y, e.v_y + upwind * state.drag_y, state.drag_y}, state.trim_y, dt);
  lean(a_x, a_y);
  if (!e.lean_known || d.state != FlightState::landing) return;
  const double part = lean_part(e.tilt_known ? p.by_sonars.touch : p.touch, e.altitude);
  out.goal.roll *= part;
  out.goal.pitch *= part;
}

void AttitudeControl::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  const double dt = seconds(tick.period);
  // blind, it turns level as it would by its model, and keeps what holds it so: the rotors damp what is left
  if (!e.rates_known && !e.tilt_known && !(e.lean_known && e.altitude >= p.contact)) {
    const auto level = [&](const TurnGains& g, TurnModel& model, double goal) {
      return turn(g, model, goal, model.angle, model.rate, dt);
    };
    out.turn = {level(p.lean, state.roll, 0), level(p.lean, state.pitch, 0), level(p.yaw, state.yaw, state.yaw.angle)};
    return;
  }
  out.turn.roll = turn(p.lean, state.roll, in.goal.roll, e.roll, e.p, dt);
  out.turn.pitch = turn(p.lean, state.pitch, in.goal.pitch, e.pitch, e.q, dt);
  // it was turned while it stood, or its heading is counted anew
  if (std::abs(wrapped(state.yaw.angle - e.yaw)) > p.astray) {
    state.yaw.angle = e.yaw;
    state.yaw.rate = e.r;
  }
  // the short way, however often it has turned round
  const double ahead = wrapped(in.goal.yaw - state.yaw.angle);
  out.turn.yaw = turn(p.yaw, state.yaw, state.yaw.angle + ahead, e.yaw, e.r, dt);
}

void MotorMixer::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const RotorLaw law{p.hover, p.exponent, p.voltage, p.battery};
  const FlightState doing = in.directive.state;
  out.motors.unlocked = doing != FlightState::halt;
  out.motors.number = static_cast<std::uint32_t>(tick.activation + 1);
  const bool steers = doing == FlightState::flying || doing == FlightState::landing;
  const TurnDemand turn = steers ? in.turn : TurnDemand{};
  const double lift = in.lift.thrust;
  // front and rear turn clockwise: more of them turns the hull to the left
  std::array<double, 4> parts = {lift - turn.yaw + turn.pitch, lift + turn.yaw - turn.roll,
                                 lift - turn.yaw - turn.pitch, lift + turn.yaw + turn.roll};
  const double battery = in.estimate.battery;
  if (in.condition.weak != Motor::none) spare(parts, in.condition.effectiveness, law.thrust(max_motor_signal, battery));
  const double dt = seconds(tick.period);
  const double part = -std::expm1(-dt / p.lag), quick_part = -std::expm1(-dt / p.quick_lag);
  for (std::size_t i = 0; i < 4; ++i) {
    double& reached = state.reached[i];
    double& signal = out.motors.signals[i];
    const double due = law.signal(parts[i] / in.condition.effectiveness[i], battery);
    const double quick = reached + (due - reached) * quick_part / part;
    signal = doing == FlightState::halt ? 0 : std::clamp(quick, 0.0, max_motor_signal);
    reached += (signal - reached) * part;
  }
}

void HelicopterReporter::run(const Tick&, const In& in, Out& out) {
  const FlightEstimate& e = in.estimate;
  out.report = {.roll = e.roll,
                .pitch = e.pitch,
                .yaw = e.yaw,
                .altitude = e.altitude,
                .x = e.x,
                .y = e.y,
                .battery = e.battery,
                .state = in.directive.state,
                .cause = in.directive.cause,
                .p = e.p,
                .q = e.q,
                .r = e.r,
                .v_x = e.v_x,
                .v_y = e.v_y,
                .climb = e.climb,
                .a_x = e.a_x,
                .a_y = e.a_y,
                .a_up = e.a_up,
                .roll_goal = in.goal.roll,
                .pitch_goal = in.goal.pitch,
                .signals = in.motors.signals,
                .pressure = in.sensors.pressure,
                .temperature = in.sensors.temperature,
                .trim_roll = in.directive.trim_roll,
                .trim_pitch = in.directive.trim_pitch};
}

template void add_task<AttitudeControl>(Registry&);
template void add_task<HelicopterReporter>(Registry&);
template void add_task<MotorMixer>(Registry&);
template void add_task<PositionControl>(Registry&);

}  // namespace jarol::tasks
