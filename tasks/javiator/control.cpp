#include "tasks/javiator/control.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"

namespace jarol::tasks {
namespace {

constexpr double gravity = 9.81;

// critically damped, s^2 + 2 w s + w^2, but for its bounds
void approach(Approach& a, double goal, const ApproachLimits& p, double dt) {
  const double speed = limited(0.5 * p.bandwidth * (goal - a.place), p.speed);
  const double wanted = limited(2 * p.bandwidth * (speed - a.speed), p.acceleration);
  a.demand += limited(wanted - a.demand, p.jerk * dt);
  a.felt += (a.demand - a.felt) * dt / (p.lag + dt);
  a.place += a.speed * dt + 0.5 * a.felt * dt * dt;
  a.speed += a.felt * dt;
}

double hold(const PositionControl::Param& p, const Approach& a, double place, double speed, double drag, double& trim,
            double dt) {
  trim = limited(trim + p.ki * (a.place - place) * dt, 1);
  return a.demand + p.kp * (a.place - place) + p.kd * (a.speed - speed) - drag + trim;
}

double turn(const TurnGains& g, TurnModel& model, double goal, double angle, double rate, double dt) {
  const double w = g.bandwidth;
  const double max = 0.8 * g.limit * g.effect;
  const double speed = limited(0.5 * w * (goal - model.angle), g.rate);
  const double acceleration = limited(2 * w * (speed - model.rate), max);
  model.angle += model.rate * dt + 0.5 * acceleration * dt * dt;
  model.rate += acceleration * dt;
  const double error = model.angle - angle;
  model.trim = limited(model.trim + g.ki * error * dt, 0.2 * g.limit);
  const double demand =
      limited(acceleration / g.effect + g.kp * error + g.kd * (model.rate - rate) + model.trim, g.limit);
  // a zero at 1/spin_time is cancelled
  model.given += (demand - model.given) * dt / (g.spin_time + dt);
  return model.given;
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

  // landing without a place it brakes by what it still knows of its speed
  if (d.state == FlightState::landing && !d.hold_position) {
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
  const double a_x = hold(p, state.x, e.x, e.v_x, state.drag_x, state.trim_x, dt);
  const double a_y = hold(p, state.y, e.y, e.v_y, state.drag_y, state.trim_y, dt);
  lean(a_x, a_y);
}

void AttitudeControl::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  const double dt = seconds(tick.period);
  // blind, it turns level as it would by its model, and keeps what holds it so: the rotors damp what is left
  if (!e.rates_known) {
    const auto level = [&](const TurnGains& g, TurnModel& model, double goal) {
      return turn(g, model, goal, model.angle, model.rate, dt);
    };
    out.turn = {level(p.lean, state.roll, 0), level(p.lean, state.pitch, 0), level(p.yaw, state.yaw, state.yaw.angle)};
    return;
  }
  out.turn.roll = turn(p.lean, state.roll, in.goal.roll, e.roll, e.p, dt);
  out.turn.pitch = turn(p.lean, state.pitch, in.goal.pitch, e.pitch, e.q, dt);
  // the short way, however often it has turned round
  const double ahead = wrapped(in.goal.yaw - state.yaw.angle);
  out.turn.yaw = turn(p.yaw, state.yaw, state.yaw.angle + ahead, e.yaw, e.r, dt);
}

void AltitudeControl::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightEstimate& e = in.estimate;
  const FlightDirective& d = in.directive;
  const double dt = seconds(tick.period);
  double& thrust = out.lift.thrust;
  if (d.state == FlightState::halt || d.state == FlightState::ground) {
    state = {};
    // rotors that still turn run down
    thrust = d.state == FlightState::halt ? 0 : std::max(thrust - dt / 1.0, 0.0);
    return;
  }
  if (d.state == FlightState::starting) {
    thrust = std::min(thrust + p.idle * dt / p.spin_up, p.idle);
    state.trim = thrust;
    return;
  }

  constexpr double ground = 0.02;  // m
  if (!state.lifted) {
    // thrust grows slowly until the ground is left, and is learnt on the way
    const bool wants_up = d.state == FlightState::flying && d.altitude > ground;
    state.trim = std::clamp(state.trim + (wants_up ? p.lift_rate : -p.lift_rate) * dt, p.idle, 1.5);
    state.lifted = (wants_up || d.state == FlightState::landing) && e.altitude > ground;
    state.z = {e.altitude, std::max(e.climb, 0.0)};
    state.expected = state.sunk = 0;
    // what lifts it is more than what carries it
    state.mean_trim = std::min(state.trim, 1.0);
    state.aloft = 0.4;
    state.blind_trim = state.blind_cut = 0;
    thrust = state.trim;
    return;
  }
  // blind: what carried it, corrected by the sonar's climb; where it is lost in the climb that thrust is half learnt
  if (!e.rates_known) {
    const bool measured = e.altitude_known && e.answers_known;
    const double excess = -p.blind_speed - e.climb;  // of its descent
    state.blind_trim =
        measured ? limited(state.blind_trim + p.blind_ki * excess * dt, 0.2) : std::min(state.blind_trim, 0.0);
    // near the ground it would stay light; where nobody measures it comes down in the end
    const double cut = !measured ? 0.005 : e.altitude < ground ? 2.0 : 0.0;  // per s
    state.blind_cut = std::min(state.blind_cut + cut * dt, 2.0);
    const double correction = std::clamp(p.blind_gain * excess, measured ? -0.2 : -0.06, 0.06);
    thrust = std::max(state.mean_trim - 0.03 + state.blind_trim - state.blind_cut + correction, 0.0);
    return;
  }
  state.blind_trim = state.blind_cut = 0;
  if (d.state == FlightState::landing) {
    state.landing += dt;
    const double overdue = std::clamp(p.overdue * (state.landing - p.landing_time), 0.0, p.touch_speed);
    // an altitude that nothing confirms may be wrong
    const bool is_high = e.altitude > 0.5 && e.altitude_known && e.pressure_known;
    const double speed = is_high ? p.descent : p.touch_speed + overdue;
    state.z.demand = limited(3 * (-speed - state.z.speed), 2);
    state.z.speed += state.z.demand * dt;
    // never far below: on the ground it would wind down all at once
    state.z.place = std::max(state.z.place + state.z.speed * dt, e.altitude - 0.15);
  } else {
    state.landing = 0;
    approach(state.z, d.altitude, p.approach, dt);
    if (d.altitude <= ground && e.altitude < ground && std::abs(e.climb) < 0.05) state.lifted = false;
  }
  // sag of the battery, flow through the rotors, the ground: whatever thrust is lost or gained is felt at once
  const double felt = e.lift / gravity;
  state.trim = std::clamp(state.trim + p.lift_bandwidth * dt * (1 + state.expected - felt), 0.4, 1.7);
  state.aloft = std::min(state.aloft + dt, 1.0);
  state.mean_trim += (state.trim - state.mean_trim) * dt / state.aloft;
  const double error = state.z.place - e.altitude;
  state.sunk = limited(state.sunk + p.ki * error * dt, 1);
  const double a = state.z.demand + p.kp * error + p.kd * (state.z.speed - e.climb) + state.sunk;
  const double upright = std::max(std::cos(e.roll) * std::cos(e.pitch), 0.5);
  thrust = std::clamp(state.trim + (1 + a / gravity) / upright - 1, 0.1, 2.0);
  state.expected += (thrust - state.trim - state.expected) * dt / (p.lift_lag + dt);
}

void MotorMixer::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const FlightState doing = in.directive.state;
  out.motors.unlocked = doing != FlightState::halt;
  const bool steers = doing == FlightState::flying || doing == FlightState::landing;
  const TurnDemand turn = steers ? in.turn : TurnDemand{};
  const double lift = in.lift.thrust;
  // front and rear turn clockwise: more of them turns the hull to the left
  const std::array<double, 4> parts = {lift - turn.yaw + turn.pitch, lift + turn.yaw - turn.roll,
                                       lift - turn.yaw - turn.pitch, lift + turn.yaw + turn.roll};
  const double battery = in.estimate.battery;
  const double made_up = battery > 0 ? std::clamp(p.voltage / battery, 0.8, 1.3) : 1.0;
  const double dt = seconds(tick.period);
  const double part = -std::expm1(-dt / p.lag), quick_part = -std::expm1(-dt / p.quick_lag);
  for (std::size_t i = 0; i < 4; ++i) {
    double& reached = state.reached[i];
    double& signal = out.motors.signals[i];
    const double due = made_up * p.hover * std::pow(std::max(parts[i], 0.0), 1 / p.exponent);
    const double quick = reached + (due - reached) * quick_part / part;
    signal = doing == FlightState::halt ? 0 : std::clamp(quick, 0.0, 16000.0);
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

}  // namespace jarol::tasks
