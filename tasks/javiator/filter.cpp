// In one file: what one period makes of all that is heard, step by step.
#include "tasks/javiator/filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "graph/math/geometry.h"
#include "graph/math/rotations.h"
#include "tasks/add_task.h"
#include "tasks/javiator/filter_checks.h"

namespace jarol::tasks {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::int64_t longest_pause = 100;  // activations: after more of them little is known anyway
constexpr double nowhere = 1e9;              // m

bool is_near(const AxisObserver& axis, double measured, double jump) { return std::abs(measured - axis.place) < jump; }

struct Below {
  double range;
  bool is_new, is_plane;
};

// The range reported for all is between the four: what two of them see wrongly moves it, and where they see no plane
// it is passed over for a while.
Below look_below(const JaviatorFilter::Param& p, const JaviatorFilter::In& in, bool tilt_known, bool new_sonar,
                 JaviatorFilter::State& state) {
  const bool new_ranges = std::exchange(state.before.ranges, in.sonars.readings) != in.sonars.readings;
  const bool is_plane = tilt_known && new_ranges && see_plane(p.unfelt.plane, in.sonars);
  const bool waits = tilt_known && state.z.since < p.unfelt.patience;
  if (!is_plane && !waits) return {in.sensors.sonar, new_sonar, false};
  const auto& [front, right, rear, left] = in.sonars.ranges;
  return {0.25 * (front + right + rear + left), is_plane, is_plane};
}

// In one period.
void step(const JaviatorFilter::Param& p, double dt, const JaviatorFilter::In& in, bool was_left_out,
          JaviatorFilter::State& state, JaviatorFilter::Out& out) {
  const JaviatorSensors& s = in.sensors;
  FlightEstimate& e = out.estimate;
  const bool fresh = s.answers != state.before.answers;
  state.before.answers = s.answers;
  if (fresh && state.unanswered > p.patience && !was_left_out) state.anew = {.begins = true, .first = nowhere};
  state.unanswered = fresh ? 0 : state.unanswered + dt;
  const double heard_dt = fresh ? dt : 0;
  const FlightState doing = in.directive.state;
  const bool settled = doing == FlightState::halt || doing == FlightState::ground;

  const bool imu =
      hear(state.imu, fresh && s.new_imu, s.roll + s.pitch + s.yaw + s.p + s.q + s.r, p.imu_repeats, heard_dt);
  if (settled) forgive(state.imu, imu);
  const bool turns = believe(state.imu, imu, p.imu_patience);
  // between readings it turns on as it did, and feels what it felt
  const double gap = state.last_turn.since;
  state.last_turn.since = turns ? 0 : state.last_turn.since + dt;
  const double felt = state.imu.lost ? 0 : std::exp(-state.last_turn.since / p.age.fade);
  const BlindMotion& blind = in.blind;
  const bool is_blind = state.imu.lost && blind.known;
  const Vector3d rates = is_blind ? Vector3d(blind.p, blind.q, blind.r) : Vector3d(felt * Vector3d(s.p, s.q, s.r));

  if (state.before.stood && !settled) {
    take_off(state.x, state.zero_x);
    take_off(state.y, state.zero_y);
    take_off(state.z, state.zero_z);
    state.z_slow = state.z;
    state.climb_off = state.climb_was_off = 0;
    state.roll_off = state.pitch_off = 0;
    state.zero_yaw += state.yaw;
    state.yaw = 0;
    state.has_flown = true;
  }
  state.before.stood = settled;

  // angles follow the rates, and what is measured unless it jumps: wrong angles would turn the rates wrongly, too
  const double angle_jump = p.angle_jump + p.unfelt.rate * std::max(gap - p.unfelt.gap, 0.0);
  const auto near = [&](double roll, double pitch) {
    return std::abs(s.roll - roll) < angle_jump && std::abs(s.pitch - pitch) < angle_jump;
  };
  const bool right = settled || (!state.angles.lost && near(state.roll, state.pitch));
  const Vector3d angle_rates = euler_rates(right ? s.roll : state.roll, right ? s.pitch : state.pitch, rates);
  state.roll += dt * angle_rates.x();
  state.pitch += dt * angle_rates.y();
  predict(state.slow_roll, angle_rates.x(), dt);
  predict(state.slow_pitch, angle_rates.y(), dt);
  state.yaw += dt * angle_rates.z();
  // the ground still carries it while the rotors take up speed
  if (!settled && in.directive.stands && turns && !feels_level(state, p, s)) state.angles.lost = true;
  if (settled) {
    state.roll = s.roll;
    state.pitch = s.pitch;
    if (!state.has_flown) state.zero_yaw = s.yaw;
    state.yaw = wrapped(s.yaw - state.zero_yaw);
    if (s.answers > 0) state.angles = {.lost = !feels_level(state, p, s)};
    rest(state.slow_roll, s.roll, angle_rates.x(), p.drift.rest);
    rest(state.slow_pitch, s.pitch, angle_rates.y(), p.drift.rest);
  }
  // over a gap it turned at the mean of the rates before and after it
  const double turned = 0.5 * (gap + dt);
  const LastTurn& last = state.last_turn;
  const bool over_gap = turns && gap > 0 && !settled;
  const double roll = over_gap ? last.roll + turned * (last.roll_rate + angle_rates.x()) : state.roll;
  const double pitch = over_gap ? last.pitch + turned * (last.pitch_rate + angle_rates.y()) : state.pitch;
  const bool smooth = near(roll, pitch);
  state.angles.silent += heard_dt;
  if (over_gap) {
    // what it turned meanwhile was not felt; what is measured may drift, and is no measure of it
    state.slow_roll.angle += roll - state.roll;
    state.slow_pitch.angle += pitch - state.pitch;
    state.roll = smooth && !state.angles.lost ? s.roll : roll;
    state.pitch = smooth && !state.angles.lost ? s.pitch : pitch;
  }
  if (turns && smooth) watch_drift(state, p, s, dt);
  if (believe(state.angles, turns && smooth, p.imu_patience)) {
    state.roll += p.angle_gain * (s.roll - state.roll);
    state.pitch += p.angle_gain * (s.pitch - state.pitch);
    state.yaw += p.angle_gain * wrapped(s.yaw - state.zero_yaw - state.yaw);
  } else if (state.angles.lost) {
    state.roll = state.slow_roll.angle;
    state.pitch = state.slow_pitch.angle;
  }
  if (turns) state.last_turn = {0, state.roll, state.pitch, angle_rates.x(), angle_rates.y()};
  if (is_blind) {
    // as the IMU would report them
    state.roll = blind.roll + in.directive.trim_roll;
    state.pitch = blind.pitch + in.directive.trim_pitch;
    state.yaw = blind.yaw;
  }

  const Matrix3d R = rotation_of(state.roll, state.pitch, state.zero_yaw + state.yaw);
  // ranges are younger than the IMU's sample
  const Matrix3d R_now = rotation_of(state.roll + p.age.range * rates.x(), state.pitch + p.age.range * rates.y(),
                                     state.zero_yaw + state.yaw + p.age.range * rates.z());
  // what carries it while nobody feels it; what is known of drag and wind as well
  const Vector3d last_b(s.a_x, s.a_y, s.a_z);
  const Vector3d hover_b =
      is_blind ? Vector3d(R.transpose() * Vector3d(blind.drag_x, blind.drag_y, 0) - Vector3d(0, 0, blind.lift))
               : Vector3d(R.transpose() * Vector3d(0, 0, -gravity));
  const Vector3d force_b = turns ? last_b : Vector3d(hover_b + felt * (last_b - hover_b));
  const Vector3d a = R * force_b + Vector3d(0, 0, gravity);
  const double last_pressure = state.pressure.last;
  const bool new_x = hear(state.laser_x, fresh && s.new_x, s.laser_x, p.laser_repeats, heard_dt);
  const bool new_y = hear(state.laser_y, fresh && s.new_y, s.laser_y, p.laser_repeats, heard_dt);
  const bool new_sonar = hear(state.sonar, fresh && s.new_sonar, s.sonar, p.repeats, heard_dt);
  const bool tilt_known = is_blind && blind.tilt_known;
  const Below below = look_below(p, in, tilt_known && !settled, new_sonar, state);
  const double z = (R * Vector3d(p.sonar_x, p.sonar_y, p.sonar_z + below.range)).z();
  const bool new_pressure = hear(state.pressure, fresh && s.new_bmu, s.pressure, p.repeats, heard_dt);
  if (settled) {
    if (s.answers > 0) {
      rest(state.x, a.x(), p.drift.rest);
      rest(state.y, a.y(), p.drift.rest);
      rest(state.z, -a.z(), p.drift.rest);
    }
    forgive(state.sonar, below.is_new);
    if (below.is_new) settle(state.z, state.zero_z, z, p.sonar_jump, state.has_flown, p.drift.rest);
    forgive(state.pressure, new_pressure);
    if (new_pressure && state.pressure.repeats == 0) learn(state.ground, s.pressure, last_pressure, p.drift.rest);
    state.disagreement = 0;
    state.anew.begins = false;
  } else {
    predict(state.x, a.x(), dt);
    predict(state.y, a.y(), dt);
    predict(state.z, -a.z(), dt);
    predict(state.z_slow, -a.z(), dt);
    if (state.anew.begins && (below.is_new || state.sonar.lost)) {
      const double first = std::exchange(state.anew.first, z);
      state.anew.begins = !state.sonar.lost && std::abs(z - first) > p.range_jump;  // one alone may be wrong
      if (!state.anew.begins && !state.sonar.lost) state.z = state.z_slow = {.place = z - state.zero_z, .since = dt};
      state.disagreement = 0;
    }
    const bool wide = below.is_plane || (state.imu.lost && !is_blind);
    const double jump = wide ? p.range_jump : p.sonar_jump + p.sonar_jump_rate * state.z.since;
    const bool credible = below.is_new && is_near(state.z, z - state.zero_z, std::min(jump, p.range_jump));
    const bool had_sonar = !state.sonar.lost;
    // blind, nothing else shows its altitude: a hover that is still is no sonar that is stuck
    const bool repeats = !is_blind && p.sonar_repeats > 0 && state.sonar.repeats >= p.sonar_repeats;
    if (believe(state.sonar, credible, p.patience) && !repeats) {
      learn_noise(state.z, z - state.zero_z, p.noise);
      // the sonar is all that shows a climb that is not felt
      if (tilt_known)
        track(state.z, z - state.zero_z, p.unfelt.climb);
      else if (state.imu.lost)
        correct(state.z, z - state.zero_z, is_blind ? p.unfelt.bandwidth : p.bandwidth);
      else
        correct(state.z, z - state.zero_z, p.bandwidth * quiet_part(state.z, p.noise));
      correct(state.z_slow, z - state.zero_z, p.drift.climb_bandwidth);
    }
    compare_climb(state, p, dt);
    // no climb is that fast: a pressure that jumps is wrong
    if (new_pressure && std::abs(s.pressure - last_pressure) > credible_step(state, p)) state.pressure.lost = true;
    if (believe(state.pressure, new_pressure, p.patience) && !state.anew.begins) weigh_pressure(state, p, s.pressure);
    // what it has learnt of late may be what is wrong with the sonar
    const bool begins_to_repeat = below.is_new && p.sonar_repeats > 0 && state.sonar.repeats == p.sonar_repeats;
    if (is_blind) {
      state.z_slow = state.z;  // what is not felt leads it nowhere
    } else if (had_sonar && (state.sonar.lost || begins_to_repeat)) {
      state.z.speed = state.z_slow.speed;
      state.z.bias = state.z_slow.bias;
    }
  }

  if (is_blind) {
    state.x.place = blind.x;
    state.y.place = blind.y;
    state.x.speed = blind.v_x;
    state.y.speed = blind.v_y;
    state.x.bias = state.y.bias = 0;
  }
  AxisObserver* const axes[] = {&state.x, &state.y};
  for (PlaceFix& fix : e.fixes) fix.is_new = false;
  double* const zeros[] = {&state.zero_x, &state.zero_y};
  // a laser measures along the axis whose wall it meets
  const auto look = [&](SensorTrust& laser, bool heard, const Vector3d& lever, int along, double range) {
    const Eigen::Vector2d expected(state.zero_x + state.x.place, state.zero_y + state.y.place);
    const WallFix fix = find_place(p.room, R_now * lever, R_now.col(along), range, expected);
    AxisObserver& axis = *axes[fix.axis];
    double& zero = *zeros[fix.axis];
    if (settled) {
      forgive(laser, heard && fix.seen);
      if (heard && fix.seen) settle(axis, zero, fix.place, p.range_jump, state.has_flown, p.drift.rest);
      return;
    }
    if (heard && fix.at_corner) return void(laser.silent = 0);  // that says nothing, and nothing of the laser
    const double jump = p.range_jump + p.unseen.speed * std::max(axis.since - p.patience, 0.0);
    const bool credible = heard && fix.seen && is_near(axis, fix.place - zero, jump);
    const bool repeats = p.laser_repeats > 0 && laser.repeats > 0;
    if (!believe(laser, credible, p.patience) || axis.since == 0 || repeats) return;
    e.fixes[fix.axis] = {.place = fix.place - zero,
                         .slope = lever.z() + range * R_now(2, along),
                         .skew = range * R_now(1 - fix.axis, along),
                         .range = range * R_now(fix.axis, along),
                         .is_new = !(is_blind && blind.turns)};
    if (is_blind) {
      if (!blind.turns) axis.since = 0;
      return;
    }
    const double doubt = range * R_now(1 - fix.axis, along) * rates.z() * p.age.spread / p.age.noise;
    correct(axis, fix.place - zero, p.bandwidth / (1 + doubt * doubt));  // slower, and damped as well as ever
  };
  look(state.laser_x, new_x, {p.laser_x_x, p.laser_x_y, p.laser_x_z}, 0, s.laser_x);
  look(state.laser_y, new_y, {p.laser_y_x, p.laser_y_y, p.laser_y_z}, 1, s.laser_y);
  if (!settled) compare_pull(state, p, dt);
  const double unseen = std::max(state.x.since, state.y.since);
  // who does not know his place along one axis takes walls for others, and what they say of the other axis is wrong too
  if (!settled && unseen >= p.unseen.max_time) state.laser_x.lost = state.laser_y.lost = true;

  const bool answers = state.unanswered <= p.imu_patience;
  // an accelerometer in flight feels the rotors along their axis, and drag across it
  const Vector3d drag = R * Vector3d(force_b.x(), force_b.y(), 0);
  e = {.roll = state.roll + p.age.imu * rates.x() - in.directive.trim_roll,
       .pitch = state.pitch + p.age.imu * rates.y() - in.directive.trim_pitch,
       .yaw = state.yaw + p.age.imu * rates.z(),
       .heading = state.zero_yaw + state.yaw + p.age.imu * rates.z(),
       .p = rates.x(),
       .q = rates.y(),
       .r = rates.z(),
       .x = state.x.place,
       .y = state.y.place,
       .altitude = state.z.place,
       .v_x = state.x.speed,
       .v_y = state.y.speed,
       .climb = state.z.speed,
       .a_x = a.x() - state.x.bias,
       .a_y = a.y() - state.y.bias,
       .a_up = -a.z() - state.z.bias,
       .lift = -force_b.z(),
       .drag_x = drag.x(),
       .drag_y = drag.y(),
       .battery =
           e.battery == 0 ? s.battery : e.battery + std::min(dt / p.age.battery_time, 1.0) * (s.battery - e.battery),
       .rates_age = state.last_turn.since,
       .fixes = e.fixes,
       .rates_known = !state.imu.lost && answers,
       .attitude_known = !state.imu.lost && !state.angles.lost,
       .lean_known = is_blind,
       .tilt_known = tilt_known,
       .touches = tilt_known && may_stand(p.unfelt.stand, state.roll, state.pitch, state.z.place),
       .altitude_known = !state.sonar.lost,
       .altitude_confirmed = !state.sonar.lost && !state.pressure.lost && std::abs(state.disagreement) < p.drift.doubt,
       .position_known = !state.laser_x.lost && !state.laser_y.lost && unseen < p.unseen.patience,
       .pressure_known = !state.pressure.lost,
       .answers_known = answers && !state.anew.begins};
}

}  // namespace

void JaviatorFilter::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const double dt = seconds(tick.period);
  const std::int64_t before = std::exchange(state.before.activation, tick.activation);
  const std::int64_t left_out = before < 0 ? 0 : tick.activation - before - 1;  // none since a restart
  if (left_out > 0) {
    // as if no answer had come meanwhile; what it last heard then is not kept, so rates and forces are those of now
    In unheard = in;
    unheard.sensors.answers = state.before.answers;
    unheard.sonars.readings = state.before.ranges;
    for (std::int64_t i = 0; i < std::min(left_out, longest_pause); ++i) step(p, dt, unheard, true, state, out);
  }
  step(p, dt, in, left_out > 0, state, out);
}

template void add_task<JaviatorFilter>(Registry&);

}  // namespace jarol::tasks
