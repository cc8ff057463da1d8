#include "tasks/lauv/navigation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph/math/geometry.h"
#include "graph/math/rotations.h"
#include "tasks/add_task.h"

namespace jarol::tasks {
namespace {

// The part of an error that a step sets right.
double share(double step, double time) { return time > step ? step / time : 1.0; }

PlaceFilter::Model model_of(const LauvNavigation::Param& p) {
  return {.drift = p.drift,
          .change = p.current_change,
          .current = p.current,
          .fix = p.fix_error,
          .range = p.range_error,
          .gate = p.gate};
}

void take_places(const LauvNavigation::Param& p, const Instruments& i, double z, LauvNavigation::State& state) {
  const PlaceFilter::Model model = model_of(p);
  if (i.place.count > state.fixes) {
    if (state.fixes < 1 || state.misfits >= p.restart) {
      state.place.begin(model, i.place.x, i.place.y);
      state.misfits = 0;
    } else if (state.place.take_fix(model, i.place.x, i.place.y)) {
      state.misfits = 0;
    } else {
      ++state.misfits;
      ++state.left_out;
    }
    state.fixes = i.place.count;
  }
  for (std::size_t k = 0; k < i.beacons.size(); ++k) {
    const BeaconReading& b = i.beacons[k];
    const bool is_new = b.count > state.ranges[k];
    state.ranges[k] = b.count;
    if (!is_new || state.fixes < 1) continue;
    if (!state.place.take_range(model, b.north, b.east, b.depth - z, b.range)) ++state.left_out;
  }
}

}  // namespace

void LauvNavigation::run(const Param& p, const Tick& tick, const In& in, State& state, Out& out) {
  const Instruments& i = in.instruments;
  Motion& m = state.motion;
  const double dt = seconds(tick.period);
  state.depth.take({p.depth_timeout, p.depth_error, p.fix_depth, p.fix_depth_error, p.surface_fixes, p.water}, i, dt);
  // without a compass the heading is the IMU's
  const double heading = i.heading.count < 0 ? i.attitude.z : i.heading.value;
  if (!state.started) {
    const std::int64_t depths = i.depth.count < 0 ? i.pressure.count : i.depth.count;
    state.started = i.attitude.count > 0 && i.heading.count != 0 && depths > 0;
    m.z = state.depth.depth;
    m.phi = i.attitude.x;
    m.theta = i.attitude.y;
    m.psi = heading;
  } else {
    const Eigen::Vector3d v_n = rotation_of(m.phi, m.theta, m.psi) * Eigen::Vector3d(m.u, m.v, m.w);
    const Eigen::Vector3d angle_rates = euler_rates(m.phi, limited(m.theta, max_pitch_of_rates), {m.p, m.q, m.r});
    state.place.predict(model_of(p), v_n.x(), v_n.y(), dt);
    m.z += dt * v_n.z();
    m.phi += dt * angle_rates.x();
    m.theta += dt * angle_rates.y();
    m.psi += dt * angle_rates.z();

    const double angles = share(dt, p.angle_time);
    m.z += share(dt, p.depth_time) * (state.depth.depth - m.z);
    m.phi += angles * wrapped(i.attitude.x - m.phi);
    m.theta += angles * wrapped(i.attitude.y - m.theta);
    m.psi = wrapped(m.psi + angles * wrapped(heading - m.psi));
  }
  take_places(p, i, m.z, state);
  m.x = state.place.s[0];
  m.y = state.place.s[1];
  const double speeds = share(dt, p.speed_time);
  m.u += speeds * (i.velocity.x - m.u);
  m.v += speeds * (i.velocity.y - m.v);
  m.w += speeds * (i.velocity.z - m.w);
  m.p = i.rates.x;
  m.q = i.rates.y;
  m.r = i.rates.z;
  out.motion = m;
  out.stream = {state.place.s[2], state.place.s[3]};
  out.accuracy = {state.fixes > 0, std::sqrt(state.place.P[0] + state.place.P[5]), state.left_out};
}

template void add_task<LauvNavigation>(Registry&);

}  // namespace jarol::tasks
