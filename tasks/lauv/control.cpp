#include "tasks/lauv/control.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"
#include "tasks/add_task.h"

namespace jarol::tasks {
namespace {

// By a propeller that does not do what it is sent. Then nothing steers: the push of a fin at the stern moves the hull
// across the flow, and what the hull does there undoes the fin's moment, more than that above some 0.6 m/s. What is
// left is how deep it goes: least with the stern lifted, and with rudders hard over, as circles cost speed.
bool is_driven_astern(const DrivenAstern& p, const Setpoint& setpoint, double surge) {
  return surge < -p.speed && (setpoint.drive == Drive::speed || setpoint.thrust >= 0);
}

double averaged(double surge, double u, double time, double dt) { return surge + (u - surge) * dt / (time + dt); }

}  // namespace

void DepthControl::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const Motion& m = in.motion;
  // z_dot: third row of R_nb times the velocity
  const double z_dot =
      -m.u * std::sin(m.theta) + m.v * std::cos(m.theta) * std::sin(m.phi) + m.w * std::cos(m.theta) * std::cos(m.phi);
  const double error = in.setpoint.depth - m.z;
  // nose down to go deeper
  const double wanted = -p.kp * error + p.kd * z_dot + state.pitch_trim;
  const double theta = limited(wanted, p.limit);
  // learn the trim only close to the depth: on the way down it would wind up; and no more of it, as where it rests at
  // the surface, than what leaves the vehicle so close that it learns again
  const double max = std::min(p.limit, p.within * p.kp * p.reach);
  if (std::abs(error) < p.reach)
    state.pitch_trim = limited(state.pitch_trim - p.ki * error * seconds(tick.period), max);
  // the rate of the Euler angle, not of the body: they differ in a turn
  const double theta_dot = m.q * std::cos(m.phi) - m.r * std::sin(m.phi);
  out.moment.angle = limited(p.pitch_kp * (theta - m.theta) - p.pitch_kd * theta_dot, p.fin_limit);
  state.surge = averaged(state.surge, m.u, p.astern.time, seconds(tick.period));
  if (is_driven_astern(p.astern, in.setpoint, state.surge)) out.moment.angle = p.fin_limit;
}

void HeadingControl::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const double error = wrapped(in.setpoint.heading - in.motion.psi);
  const double rate = limited(in.setpoint.turn == Turn::rate ? in.setpoint.rate : p.kp * error, p.rate_limit);
  out.moment.angle = limited(p.rate_kp * (rate - in.motion.r), p.fin_limit);
  state.surge = averaged(state.surge, in.motion.u, p.astern.time, seconds(tick.period));
  if (is_driven_astern(p.astern, in.setpoint, state.surge)) out.moment.angle = p.fin_limit;
}

void SpeedControl::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  if (in.setpoint.drive == Drive::thrust) {
    state = {};
    out.thrust.actuation = limited(in.setpoint.thrust, 1);
    return;
  }
  if (in.setpoint.speed <= 0) {
    state = {};
    out.thrust.actuation = 0;
    return;
  }
  const double error = in.setpoint.speed - in.motion.u;
  const double wanted = p.feed_forward * in.setpoint.speed + p.kp * error + state.integral;
  const double actuation = std::clamp(wanted, 0.0, 1.0);
  if (actuation == wanted) state.integral += p.ki * error * seconds(tick.period);
  out.thrust.actuation = actuation;
}

void FinAllocator::run(const Tick&, const In& in, Out& out) {
  // positive on 0 and 3 turns to port, positive on 1 and 2 noses down: both demands change sign
  out.actuation.fins = {-in.yaw.angle, -in.pitch.angle, -in.pitch.angle, -in.yaw.angle};
  out.actuation.thruster = in.thrust.actuation;
}

void LauvReport::run(const Tick&, const In& in, Out& out) {
  out.report = {in.motion.z, in.motion.theta, in.motion.psi, in.motion.u, in.condition.alarm, in.condition.fins};
}

void LauvForward::run(const Tick&, const In& in, Out& out) { out = {in.motion, in.actuation}; }

template void add_task<DepthControl>(Registry&);
template void add_task<FinAllocator>(Registry&);
template void add_task<HeadingControl>(Registry&);
template void add_task<LauvForward>(Registry&);
template void add_task<LauvReport>(Registry&);
template void add_task<SpeedControl>(Registry&);

}  // namespace jarol::tasks
