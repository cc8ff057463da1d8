#include "tasks/lauv/navigation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph/math/geometry.h"

namespace jarol::tasks {
namespace {

// The part of an error that a step sets right.
double share(double step, double time) { return time > step ? step / time : 1.0; }

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

    m.x += dt * (ahead * std::cos(m.psi) - aside * std::sin(m.psi));
    m.y += dt * (ahead * std::sin(m.psi) + aside * std::cos(m.psi));
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
  if (i.place.count > state.fixes) {
    // the first fix sets the place, the others draw it near
    const double part = state.fixes == 0 ? 1.0 : share(1.0, p.place_time);
    m.x += part * (i.place.x - m.x);
    m.y += part * (i.place.y - m.y);
    state.fixes = i.place.count;
  }
  const double speeds = share(dt, p.speed_time);
  m.u += speeds * (i.velocity.x - m.u);
  m.v += speeds * (i.velocity.y - m.v);
  m.w += speeds * (i.velocity.z - m.w);
  m.p = i.rates.x;
  m.q = i.rates.y;
  m.r = i.rates.z;
  out.motion = m;
}

}  // namespace jarol::tasks
