#include "tasks/lauv/supervisor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "graph/math/euler_angles.h"
#include "graph/math/geometry.h"
#include "graph/math/rotations.h"
#include "tasks/add_task.h"
#include "tasks/lauv/actuator_checks.h"
#include "tasks/lauv/depth_source.h"

namespace jarol::tasks {
namespace {

constexpr double in_water = 0.5;        // between what a leak sensor reads, 0 or 1
constexpr double out_of_reach = -1000;  // m, of depth
constexpr std::array leak_alarms{Alarm::leak, Alarm::leak1, Alarm::leak2, Alarm::leak3};  // by their order

// By the gauge, or by the pressure where no gauge is fitted.
double depth_of(const LauvSupervisor::Param& p, const Instruments& i) {
  return i.depth.count < 0 && i.pressure.count > 0 ? calc_depth(p.reckoning.water, i.pressure.value) : i.depth.value;
}

Alarm find_lost(const LauvSupervisor::Param& p, const Instruments& i, double dt, LauvSupervisor::State& state) {
  struct Watched {
    std::int64_t count;
    Alarm lost;
    bool needed = false;  // without it, or one like it, nothing can be steered
  };
  const Watched watched[] = {{i.depth.count, Alarm::depth_gauge, i.pressure.count < 0},
                             {i.pressure.count, Alarm::ctd},
                             {i.attitude.count, Alarm::attitude, true},
                             {i.rates.count, Alarm::attitude},
                             {i.forces.count, Alarm::forces},
                             {i.heading.count, Alarm::heading},
                             {i.velocity.count, Alarm::speed, true},
                             {i.rpm.count, Alarm::speed},
                             {i.altitude.count, Alarm::altimeter},
                             {i.conductivity.count, Alarm::ctd},
                             {i.water_temperature.count, Alarm::ctd},
                             {i.leak.count, Alarm::leak},
                             {i.leak1.count, Alarm::leak1},
                             {i.leak2.count, Alarm::leak2},
                             {i.leak3.count, Alarm::leak3},
                             {i.voltage.count, Alarm::battery},
                             {i.current.count, Alarm::battery}};
  if (!state.heard) {
    state.heard = std::any_of(std::begin(watched), std::end(watched), [](const Watched& w) { return w.count > 0; });
    // from now on each instrument has its time, whenever the vehicle came
    if (state.heard) {
      if (state.alarm == Alarm::no_vehicle) state.alarm = Alarm::none;
      state.silences = {};
      state.since_fix = 0;
    }
  }
  Alarm found = Alarm::none;
  for (std::size_t k = state.counts.size(); k-- > 0;) {
    const Watched& w = watched[k];
    const bool fitted = w.count >= 0;
    state.silences[k] = w.count > state.counts[k] || !fitted ? 0 : state.silences[k] + dt;
    state.counts[k] = w.count;
    if (state.silences[k] > p.sensor_timeout || (w.needed && !fitted)) found = w.lost;
  }
  // GPS reports nothing under water
  state.since_fix =
      i.place.count > state.fixes || i.place.count < 0 || depth_of(p, i) > p.fix_depth ? 0 : state.since_fix + dt;
  state.fixes = i.place.count;
  if (found == Alarm::none && state.since_fix > p.gps_timeout) found = Alarm::gps;
  return found == Alarm::none || state.heard ? found : Alarm::no_vehicle;
}

// The sensor with water that is the alarm now, else the first with any.
Alarm find_leak(const Instruments& i, Alarm now) {
  Alarm found = Alarm::none;
  for (std::size_t k = hull_sensors; k-- > 0;)
    if ((i.*leak_readings[k]).value > in_water && (found == Alarm::none || found != now)) found = leak_alarms[k];
  return found;
}

// Since any instrument was heard last.
double calc_silence(const LauvSupervisor::State& state) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < state.counts.size(); ++k)
    if (state.counts[k] >= 0) least = std::min(least, state.silences[k]);
  return least;
}

// Speed of the propeller through quadratic and linear drag, at once and for ever.
double calc_force(const LauvSupervisor::Param& p, double rpm, double speed) {
  const double n = rpm * std::numbers::pi / 30;  // rad/s
  const double thrust = (p.thrust_coefficient * n - p.advance_coefficient * speed) * std::abs(n);
  return limited(thrust, p.max_thrust) - p.surge_drag * speed * (1 + p.reckoning.drag_growth * std::abs(speed));
}

Alarm find_liar(const LauvSupervisor::Param& p, const Instruments& i, double dt, LauvSupervisor::State& state) {
  const auto told = [](const auto&... readings) { return (... && (readings.count > 0)); };
  const bool turns = told(i.attitude, i.rates), moves = told(i.velocity, i.rpm),
             sounds = told(i.altitude, i.depth, i.attitude);
  const double theta = i.attitude.y, phi = i.attitude.x;
  const double floor = vertical_part(i.altitude.value, phi, limited(theta, max_pitch_of_rates)) + i.depth.value;
  if (turns && !std::exchange(state.attitude_started, true)) {
    state.theta = theta;
    state.psi = i.attitude.z;
  }
  if (moves && !std::exchange(state.speed_started, true)) state.speed = i.velocity.x;
  if (sounds && !std::exchange(state.floor_started, true)) state.floor = floor;
  const double part = std::min(dt / p.reckoning.angle_time, 1.0);
  const Eigen::Vector3d angle_rates =
      euler_rates(phi, limited(theta, max_pitch_of_rates), {i.rates.x, i.rates.y, i.rates.z});
  state.theta += dt * angle_rates.y();
  state.psi += dt * angle_rates.z();
  const double theta_error = theta - state.theta, psi_error = wrapped(i.attitude.z - state.psi);
  state.theta += part * theta_error;
  state.psi += part * psi_error;
  state.speed += dt * calc_force(p, i.rpm.value, state.speed) / p.surge_mass;
  const double floor_error = floor - state.floor;
  state.floor += std::min(dt / p.reckoning.floor_time, 1.0) * floor_error;

  const double depth = calc_depth(p.reckoning.water, i.pressure.value);
  const double force_error =
      std::hypot(i.forces.x - gravity * std::sin(theta), i.forces.y + gravity * std::cos(theta) * std::sin(phi),
                 i.forces.z + gravity * std::cos(theta) * std::cos(phi));
  struct Difference {
    bool known;
    double size, limit, time;
    Alarm alarm;
  };
  const Difference differences[] = {
      {turns, theta_error, p.angle_error, p.error_time, Alarm::attitude},
      {turns, psi_error, p.angle_error, p.error_time, Alarm::attitude},
      {told(i.attitude, i.forces), force_error, p.force_error, p.error_time, Alarm::forces},
      {told(i.attitude, i.heading), wrapped(i.heading.value - i.attitude.z), p.heading_error, p.error_time,
       Alarm::heading},
      // the gauge may be out of the water
      {told(i.depth, i.pressure), std::max(i.depth.value, 0.0) - std::max(depth, 0.0), p.depth_error, p.error_time,
       Alarm::depth_gauge},
      {moves, i.velocity.x - state.speed, p.speed_error, p.speed_error_time, Alarm::speed},
      {sounds, floor_error, p.floor_error, p.error_time, Alarm::altimeter}};
  Alarm found = Alarm::none;
  for (std::size_t k = state.wrong_for.size(); k-- > 0;) {
    const Difference& d = differences[k];
    state.wrong_for[k] = d.known && std::abs(d.size) > d.limit ? state.wrong_for[k] + dt : 0;
    if (state.wrong_for[k] > d.time) found = d.alarm;
  }
  return found;
}

double calc_heave(const Instruments& i) {
  return sinking_across(i.attitude.x, i.attitude.y, i.velocity.y, i.velocity.z);
}

bool moves_known(const Instruments& i) { return i.attitude.count > 0 && i.velocity.count > 0; }

void note_heave(const LauvSupervisor::Param& p, const Instruments& i, double dt, LauvSupervisor::State& state) {
  if (!moves_known(i)) return;
  const double heave = calc_heave(i);
  if (!std::exchange(state.heave_started, true)) state.heave = heave;
  state.heave += std::min(dt / p.levelling.heave_time, 1.0) * (heave - state.heave);
}

// How much deeper it gets while it levels off: z_dot / u, the slope of its path, times a length of way. The moments of
// fins and hull go with the square of u, so that this is one length at any speed: of the submarines in specs/vehicles
// 1.6 to 1.8 m where they sink steadily at 0.7 to 2 m/s, up to 2.3 m at 0.5 m/s or while the nose still goes down.
// Waves and the noise of the log move it to and fro across the hull, and no deeper: of that what lasts counts.
double calc_way_down(const LauvSupervisor::Param& p, const Instruments& i, const LauvSupervisor::State& state) {
  if (!moves_known(i)) return 0;
  const double z_dot = -i.velocity.x * std::sin(i.attitude.y) + std::min(calc_heave(i), state.heave);
  return p.levelling_length * std::max(z_dot, 0.0) / std::max(i.velocity.x, p.levelling.min_speed);
}

Alarm find_exceeded(const LauvSupervisor::Param& p, const LauvSupervisor::In& in, const LauvSupervisor::State& state) {
  const Instruments& i = in.instruments;
  if (in.contact.silence > p.operator_timeout) return Alarm::operator_lost;
  const double way_down = calc_way_down(p, i, state);
  if (depth_of(p, i) + way_down > p.max_depth) return Alarm::depth_limit;
  // above the floor, not along the beam
  const double altitude = vertical_part(i.altitude.value, i.attitude.x, i.attitude.y);
  if (i.altitude.count > 0 && altitude - way_down < p.min_altitude) return Alarm::altitude_limit;
  if (std::abs(i.attitude.y) > p.max_pitch) return Alarm::pitch_limit;
  if (is_low(p, i.voltage)) return Alarm::voltage_limit;
  return Alarm::none;
}

// Without attitude and speed nothing can be steered, and without its propeller nothing driven; without GPS it is at the
// surface, and stays.
bool steerable(Alarm alarm) {
  switch (alarm) {
    case Alarm::attitude:
    case Alarm::forces:
    case Alarm::speed:
    case Alarm::pitch_limit:
    case Alarm::voltage_limit:
    case Alarm::gps:
    case Alarm::propeller:
    case Alarm::no_vehicle:
    case Alarm::vehicle_lost: return false;
    case Alarm::none:
    case Alarm::operator_lost:
    case Alarm::depth_limit:
    case Alarm::altitude_limit:
    case Alarm::leak:
    case Alarm::leak1:
    case Alarm::leak2:
    case Alarm::leak3:
    case Alarm::depth_gauge:
    case Alarm::heading:
    case Alarm::altimeter:
    case Alarm::ctd:
    case Alarm::battery:
    case Alarm::bottom_fin:
    case Alarm::port_fin:
    case Alarm::starboard_fin:
    case Alarm::top_fin: return true;
  }
  return false;
}

}  // namespace

void LauvSupervisor::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const double dt = seconds(tick.period);
  Alarm lost = find_lost(p, in.instruments, dt, state);
  const Alarm liar = find_liar(p, in.instruments, dt, state);
  note_heave(p, in.instruments, dt, state);
  const ActuatorCheck actuators = check_actuators(p, in, state);
  const FinCheck fins = are_fins_unchecked(p, in.fins, dt, state) ? FinCheck::unchecked : actuators.fins;
  // old readings do not fit each other either
  const bool is_wrong = lost != Alarm::none || liar != Alarm::none;
  if (state.heard && is_wrong && calc_silence(state) > p.vehicle_timeout) lost = Alarm::vehicle_lost;
  const bool stopped = in.contact.stops != state.stops;
  state.stops = in.contact.stops;
  const Alarm leak = find_leak(in.instruments, state.alarm);
  if (state.alarm == Alarm::none || stopped) {
    Alarm found = Alarm::none;
    for (const Alarm next : {leak, lost, liar, actuators.alarm, find_exceeded(p, in, state)})
      if (found == Alarm::none) found = next;
    if (state.alarm == Alarm::none || found == Alarm::none) {
      state.alarm = found;
      state.fixes_at_alarm = in.instruments.place.count;
      state.depth_at_alarm = depth_of(p, in.instruments);
      state.since_alarm = 0;
      state.surfaced = false;
    }
    if (state.alarm == Alarm::none) {
      out = {in.setpoint, {.fins = fins}};
      return;
    }
  }
  // how it comes up stays: what can't be steered can't be for a leak
  if (leak != Alarm::none) state.surfaced |= !steerable(std::exchange(state.alarm, leak));
  // a climb gone wrong is given up
  if (!steerable(lost) || !steerable(liar)) state.surfaced = true;
  if (in.instruments.depth.count < 0 && in.instruments.pressure.count < 0) state.surfaced = true;
  const bool sinks = depth_of(p, in.instruments) > state.depth_at_alarm + p.climb_sink;
  if (sinks && state.alarm != Alarm::depth_gauge) state.surfaced = true;
  state.since_alarm += dt;
  if (in.instruments.place.count > state.fixes_at_alarm || state.since_alarm > p.climb_time) state.surfaced = true;
  const bool climbs = steerable(state.alarm) && !state.surfaced;
  // nose up as far as the depth control goes, whatever the gauge reads
  out.setpoint = {climbs ? out_of_reach : 0.0, in.setpoint.heading, climbs ? p.climb_speed : 0.0};
  out.condition = {state.alarm, fins};
}

template void add_task<LauvSupervisor>(Registry&);

}  // namespace jarol::tasks
