#include "tasks/lauv/navigation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph/math/geometry.h"

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
  if (!state.started) {
    state.started = i.attitude.count > 0 && i.heading.count > 0 && i.depth.count > 0;
    m.z = i.depth.value;
    m.phi = i.attitude.x;
    m.theta = i.attitude.y;
    m.psi = i.heading.value;
  } else {
    const double c_phi = std::cos(m.phi), s_phi = std::sin(m.phi);
    const double c_theta = std::max(std::cos(m.theta), 0.1), s_theta = std::sin(m.theta);
    const double turn = m.q * s_phi + m.r * c_phi, lifted = m.v * s_phi + m.w * c_phi;
    const double ahead = m.u * c_theta + lifted * s_theta, aside = m.v * c_phi - m.w * s_phi;

    state.place.predict(model_of(p), ahead * std::cos(m.psi) - aside * std::sin(m.psi),
                        ahead * std::sin(m.psi) + aside * std::cos(m.psi), dt);
    m.z += dt * (lifted * c_theta - m.u * s_theta);
    m.phi += dt * (m.p + turn * s_theta / c_theta);
    m.theta += dt * (m.q * c_phi - m.r * s_phi);
    m.psi += dt * turn / c_theta;

    const double angles = share(dt, p.angle_time);
    m.z += share(dt, p.depth_time) * (i.depth.value - m.z);
    m.phi += angles * wrapped(i.attitude.x - m.phi);
    m.theta += angles * wrapped(i.attitude.y - m.theta);
    m.psi = wrapped(m.psi + angles * wrapped(i.heading.value - m.psi));
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

}  // namespace jarol::tasks
