#include "tasks/lauv/guidance.h"

#include <algorithm>
#include <cmath>

#include "graph/math/euler_angles.h"
#include "tasks/add_task.h"

namespace jarol::tasks {
namespace {

using Param = LauvGuidance::Param;
using In = LauvGuidance::In;
using State = LauvGuidance::State;

void begin(const Param& p, const In& in, State& state) {
  const bool joins = state.has_end && std::hypot(in.motion.x - state.end_x, in.motion.y - state.end_y) <
                                          p.joins * p.reach + std::abs(in.leg.surge) / p.turn_rate;
  const State before = state;
  state = {.number = in.leg.number,
           .begin_x = joins ? before.end_x : in.motion.x,
           .begin_y = joins ? before.end_y : in.motion.y,
           .fixes = in.instruments.place.count,
           .depth = in.motion.z};
  state.has_end = in.leg.course == Course::line;
  state.end_x = in.leg.north;
  state.end_y = in.leg.east;
  state.descends = in.leg.vertical == Vertical::altitude || in.leg.level > in.motion.z;
}

double integrate(const Param& p, double dt, double e, State& state) {
  if (std::abs(e) < p.reach) {
    const double y = e + state.sigma;
    state.sigma =
        limited(state.sigma + dt * p.integral * p.lookahead * e / (p.lookahead * p.lookahead + y * y), p.lookahead);
  }
  return std::atan((e + state.sigma) / p.lookahead);
}

// The heading on which a course is kept in the stream; across it, as far as the speed allows.
double crab(const Param& p, const In& in, double chi) {
  const double across = in.stream.east * std::cos(chi) - in.stream.north * std::sin(chi);
  const double through = std::max({in.motion.u, in.leg.drive == Drive::speed ? in.leg.surge : 0, p.min_speed});
  return wrapped(chi - std::asin(limited(across / through, p.max_drift)));
}

// Over ground, along that course.
double speed_along(const Param& p, const In& in, double chi) {
  return std::max(in.motion.u + in.stream.north * std::cos(chi) + in.stream.east * std::sin(chi), p.min_speed);
}

// The line from where it began, and the vehicle beside it.
struct Line {
  double chi = 0;          // its course
  double left = 0;         // m along it, until its end
  double cross_track = 0;  // m to starboard
};

Line measure_line(const In& in, const State& state) {
  const double dx = in.leg.north - state.begin_x, dy = in.leg.east - state.begin_y, length = std::hypot(dx, dy);
  const double chi = length > 0 ? std::atan2(dy, dx) : in.motion.psi;
  const double x = in.motion.x - state.begin_x, y = in.motion.y - state.begin_y;
  return {chi, length - (x * std::cos(chi) + y * std::sin(chi)), y * std::cos(chi) - x * std::sin(chi)};
}

double follow_line(const Param& p, const In& in, double dt, State& state, Progress& progress) {
  const double radius = in.motion.u / p.turn_rate, miss = std::max(p.miss, 2 * radius);
  Line line = measure_line(in, state);
  // past its end, but not by it: there anew, from here
  if (line.left <= 0 && std::hypot(line.left, line.cross_track) > miss) {
    state.begin_x = in.motion.x;
    state.begin_y = in.motion.y;
    state.sigma = 0;
    state.returns = true;
    line = measure_line(in, state);
  }
  progress.cross_track = line.cross_track;
  progress.distance = std::hypot(in.leg.north - in.motion.x, in.leg.east - in.motion.y);
  const bool turns = in.leg.turn != 0 && !state.returns;
  const double lead = turns ? radius * std::tan(std::min(std::abs(in.leg.turn), p.max_turn) / 2) : 0;
  progress.near =
      (line.left <= std::max(lead, 0.0) && std::abs(line.cross_track) <= miss) || progress.distance < p.reach;
  progress.left = std::max(line.left, 0.0) / speed_along(p, in, line.chi);
  return line.chi - integrate(p, dt, progress.cross_track, state);
}

double follow_circle(const Param& p, const In& in, double dt, State& state, Progress& progress) {
  const double x = in.motion.x - in.leg.north, y = in.motion.y - in.leg.east, radius = std::abs(in.leg.radius);
  const double side = in.leg.radius < 0 ? -1 : 1, gamma = std::atan2(y, x);
  progress.distance = std::hypot(x, y);
  progress.cross_track = progress.distance - radius;
  progress.near = std::abs(progress.cross_track) < p.reach;
  const double chi = gamma + side * (pi / 2 + integrate(p, dt, progress.cross_track, state));
  if (!progress.near) return chi;
  const double slip = std::atan2(in.motion.v, std::max(in.motion.u, p.min_speed));
  return chi + side * p.heading_time * speed_along(p, in, chi) / std::max(radius, p.reach) - slip;
}

// Towards its centre from its radius on, until a part of that is left.
double keep_station(const Param& p, const In& in, State& state, Progress& progress) {
  const double x = in.leg.north - in.motion.x, y = in.leg.east - in.motion.y, radius = std::max(in.leg.radius, p.reach);
  progress.distance = std::hypot(x, y);
  progress.near = progress.distance < radius;
  if (!progress.near || !state.arrived) state.drifted = true;
  if (progress.distance < p.station.back * radius) state.drifted = false;
  return std::atan2(y, x);
}

// Farther off its circle or station than what it swings about them: its time there does not count on.
bool is_swept_away(const Param& p, const Leg& leg, const Progress& progress) {
  if (leg.course == Course::circle) return std::abs(progress.cross_track) > p.miss;
  return leg.course == Course::station && progress.distance > p.station.edge * std::max(leg.radius, p.reach);
}

bool level_is_known(const In& in) { return in.leg.vertical == Vertical::depth || in.instruments.altitude.count > 0; }

double depth_of(const In& in, double z) {
  if (in.leg.vertical == Vertical::depth) return z;
  const Motion& m = in.motion;
  if (!level_is_known(in)) return m.z;
  return std::max(m.z + vertical_part(in.instruments.altitude.value, m.phi, m.theta) - z, 0.0);
}

// The depth goes up and down as fast as that pitch lets it; it turns where the vehicle has come to.
double go_up_and_down(const Param& p, const In& in, double dt, State& state) {
  const double up = in.leg.vertical == Vertical::altitude ? 1 : -1;
  const double top = std::max(depth_of(in, in.leg.level + up * in.leg.amplitude), 0.0),
               bottom = depth_of(in, in.leg.level - up * in.leg.amplitude);
  if (state.descends ? in.motion.z > bottom - p.level : in.motion.z < top + p.level) state.descends = !state.descends;
  const double rate = std::max(in.motion.u, p.min_speed) * std::sin(in.leg.slope);
  state.depth = std::clamp(state.depth + (state.descends ? dt : -dt) * rate, top, std::max(top, bottom));
  return state.depth;
}

}  // namespace

void LauvGuidance::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const Leg& leg = in.leg;
  if (leg.course == Course::none) {
    state = {};
    out = {in.setpoint, {}};
    return;
  }
  if (leg.number != state.number) begin(p, in, state);
  const double dt = seconds(tick.period);
  Progress& progress = out.progress = {.on_leg = leg.number};
  Setpoint& to = out.setpoint = {.heading = in.motion.psi, .drive = leg.drive};
  const bool yoyo = leg.course == Course::line && leg.amplitude > 0 && leg.slope > 0;
  const double depth = depth_of(in, leg.level);
  to.depth = yoyo ? go_up_and_down(p, in, dt, state) : depth;
  bool drives = true;
  switch (leg.course) {
    case Course::line: to.heading = crab(p, in, follow_line(p, in, dt, state, progress)); break;
    case Course::circle: to.heading = crab(p, in, follow_circle(p, in, dt, state, progress)); break;
    case Course::station:
      to.heading = crab(p, in, keep_station(p, in, state, progress));
      drives = state.drifted;
      if ((state.arrived || progress.near) && progress.distance < p.station.edge * leg.radius) to.depth = 0;
      break;
    case Course::fix:
    case Course::rest:
    case Course::none:
      progress.near = true;
      drives = false;
      break;
  }
  to.speed = drives ? leg.surge : 0;
  to.thrust = drives ? leg.thrust : 0;
  progress.levelled = level_is_known(in) && std::abs(depth - in.motion.z) < p.level;

  state.arrived |= progress.near;
  const bool lasts = leg.course != Course::line;
  if (state.arrived && !is_swept_away(p, leg, progress)) state.since += dt;
  if (lasts) progress.left = leg.duration > 0 ? std::max(leg.duration - state.since, 0.0) : -1;
  const std::int64_t fixes = in.instruments.place.count;
  const bool over = leg.course == Course::fix ? fixes < 0 || fixes > state.fixes
                    : lasts                   ? leg.duration > 0 && state.since >= leg.duration
                                              : progress.near;
  state.done |= leg.until_level ? progress.levelled : over;
  progress.done = state.done;
}

template void add_task<LauvGuidance>(Registry&);

}  // namespace jarol::tasks
