#include "tasks/javiator/observers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "graph/math/geometry.h"

namespace jarol::tasks {

void predict(AxisObserver& axis, double acceleration, double dt) {
  const double a = acceleration - axis.bias;
  axis.place += axis.speed * dt + 0.5 * a * dt * dt;
  axis.speed += a * dt;
  axis.since += dt;
}

void correct(AxisObserver& axis, double measured, double bandwidth) {
  const double residual = measured - axis.place;
  const double T = axis.since;
  const double pole = std::exp(-bandwidth * T);
  axis.place += (1 - pole * pole * pole) * residual;
  axis.speed += 1.5 * (1 - pole) * (1 - pole) * (1 + pole) * residual / T;
  axis.bias -= std::pow(1 - pole, 3) * residual / (T * T);
  axis.since = 0;
}

void learn_noise(AxisObserver& axis, double measured, const ReadingNoise& by) {
  const double residual = measured - axis.place;
  axis.residual_squared += by.part * (residual * residual - axis.residual_squared);
}

double quiet_part(const AxisObserver& axis, const ReadingNoise& by) {
  return by.usual / std::max(by.usual, std::sqrt(axis.residual_squared));
}

void track(AxisObserver& axis, double measured, const UnfeltClimb& by) {
  const double residual = measured - axis.place;
  const double T = axis.since;
  const double lambda = by.push * T * T / by.noise;
  const double r = (4 + lambda - std::sqrt(lambda * (8 + lambda))) / 4;
  const double alpha = 1 - r * r, beta = 2 * (1 - r) * (1 - r);
  axis.place += alpha * residual;
  axis.speed += beta * residual / T;
  axis.bias -= 0.5 * beta * beta / alpha * residual / (T * T);
  axis.since = 0;
}

void predict(SlowAngle& slow, double rate, double dt) { slow.angle += (rate - slow.bias) * dt; }

void correct(SlowAngle& slow, double measured, double bandwidth, double dt) {
  const double residual = measured - slow.angle;
  const double pole = std::exp(-bandwidth * dt);
  slow.angle += (1 - pole * pole) * residual;
  slow.bias -= (1 - pole) * (1 - pole) * residual / dt;
}

void rest(AxisObserver& axis, double acceleration, const RestLearning& by) {
  axis = {.place = axis.place, .bias = axis.bias + by.bias_part * (acceleration - axis.bias), .seen = axis.seen};
}

void settle(AxisObserver& axis, double& zero, double measured, double jump, bool has_flown, const RestLearning& by) {
  const bool is_first = axis.seen == AxisObserver{}.seen;
  const double step = measured - std::exchange(axis.seen, measured);
  if (!is_first && std::abs(step) > jump) return;
  if (has_flown) {
    axis.place += by.place_part * (measured - zero - axis.place);
  } else {
    // two that agree deny what one alone began with
    const bool begins = is_first || std::abs(measured - zero) > jump;
    zero += (begins ? 1 : by.place_part) * (measured - zero);
  }
}

void take_off(AxisObserver& axis, double& zero) {
  zero += axis.place;
  axis.place = 0;
}

void rest(SlowAngle& slow, double measured, double rate, const RestLearning& by) {
  slow = {.angle = measured, .bias = slow.bias + by.bias_part * (rate - slow.bias)};
}

void learn(GroundPressure& ground, double pressure, double last, const RestLearning& by) {
  ground.readings = std::min(ground.readings + 1, by.steps);
  if (ground.readings == 1) {
    ground.mean = pressure;
    return;
  }
  ground.mean += by.pressure_part * (pressure - ground.mean);
  const double step = limited(pressure - last, by.max_step);
  ground.step_squared += (step * step - ground.step_squared) / (ground.readings - 1);
}

}  // namespace jarol::tasks
