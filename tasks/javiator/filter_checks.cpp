#include "tasks/javiator/filter_checks.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"

namespace jarol::tasks {

void compare_climb(JaviatorFilter::State& state, const JaviatorFilter::Param& p, double dt) {
  state.climb_off += (state.z.speed - state.z_slow.speed - state.climb_off) * dt / p.drift.climb_time;
  state.climb_was_off = std::max(state.climb_was_off * (1 - dt / p.drift.climb_memory), std::abs(state.climb_off));
}

double credible_step(const JaviatorFilter::State& state, const JaviatorFilter::Param& p) {
  return std::clamp(p.pressure_noise * std::sqrt(state.ground.step_squared), p.pressure_jump, 4 * p.pressure_jump);
}

void weigh_pressure(JaviatorFilter::State& state, const JaviatorFilter::Param& p, double pressure) {
  const double residual = (state.ground.mean - pressure) / p.pascal_per_metre - state.z.place;
  state.disagreement += p.drift.new_part * (residual - state.disagreement);
  if (!state.sonar.lost && std::abs(state.disagreement) > p.disagreement) {
    if (state.climb_was_off < p.drift.climb) {
      state.pressure.lost = true;
    } else {
      state.sonar.lost = true;
    }
  }
  if (!state.sonar.lost) return;
  state.z.place += p.by_pressure.place * residual;
  state.z.speed += p.by_pressure.speed * residual;
}

void compare_pull(JaviatorFilter::State& state, const JaviatorFilter::Param& p, double dt) {
  const double heading = state.zero_yaw + state.yaw, c = std::cos(heading), s = std::sin(heading);
  const double forward = c * state.x.bias + s * state.y.bias, right = c * state.y.bias - s * state.x.bias;
  const double part = dt / p.drift.pull_time;
  state.roll_off += (right / gravity - state.roll_off) * part;
  state.pitch_off += (-forward / gravity - state.pitch_off) * part;
}

void watch_drift(JaviatorFilter::State& state, const JaviatorFilter::Param& p, const JaviatorSensors& s, double dt) {
  if (state.angles.lost) return;
  correct(state.slow_roll, s.roll, p.drift.angle_bandwidth, dt);
  correct(state.slow_pitch, s.pitch, p.drift.angle_bandwidth, dt);
  // rates alone go astray where readings are lost or late, places where their sensors fail
  const auto drifts = [&](double by_rates, double by_places) {
    return by_rates * by_places > 0 && std::abs(by_rates) > p.drift.angle && std::abs(by_places) > p.drift.pull;
  };
  state.angles.lost = drifts(state.roll - state.slow_roll.angle, state.roll_off) ||
                      drifts(state.pitch - state.slow_pitch.angle, state.pitch_off);
}

bool feels_level(JaviatorFilter::State& state, const JaviatorFilter::Param& p, const JaviatorSensors& s) {
  const double roll = std::atan2(-s.a_y, -s.a_z), pitch = std::atan2(s.a_x, std::hypot(s.a_y, s.a_z));
  state.slant_roll += p.drift.new_part * (roll - s.roll - state.slant_roll);
  state.slant_pitch += p.drift.new_part * (pitch - s.pitch - state.slant_pitch);
  return std::abs(state.slant_roll) < p.angle_jump && std::abs(state.slant_pitch) < p.angle_jump;
}

}  // namespace jarol::tasks
