#include "tasks/javiator/observers.h"

#include <algorithm>
#include <cmath>

#include "graph/math/geometry.h"

namespace jarol::tasks {

void predict(AxisObserver& axis, double acceleration, double dt) {
  const double a = acceleration - axis.bias;
  axis.place += axis.speed * dt + 0.5 * a * dt * dt;
  axis.speed += a * dt;
  axis.since += dt;
}

// gains of the critically damped filter of third order, with its poles at e^(-bandwidth T) (Brookner, "Tracking and
// Kalman Filtering Made Easy", 1998, sec. 1.3)
void correct(AxisObserver& axis, double measured, double bandwidth) {
  const double residual = measured - axis.place;
  const double T = axis.since;
  const double pole = std::exp(-bandwidth * T);
  axis.place += (1 - pole * pole * pole) * residual;
  axis.speed += 1.5 * (1 - pole) * (1 - pole) * (1 + pole) * residual / T;
  axis.bias -= std::pow(1 - pole, 3) * residual / (T * T);
  axis.since = 0;
}

void predict(SlowAngle& slow, double rate, double dt) { slow.angle += (rate - slow.bias) * dt; }

// gains of the critically damped filter of second order (Brookner, sec. 1.2)
void correct(SlowAngle& slow, double measured, double bandwidth, double dt) {
  const double residual = measured - slow.angle;
  const double pole = std::exp(-bandwidth * dt);
  slow.angle += (1 - pole * pole) * residual;
  slow.bias -= (1 - pole) * (1 - pole) * residual / dt;
}

void rest(AxisObserver& axis, double acceleration) {
  axis = {.place = axis.place, .bias = axis.bias + 0.02 * (acceleration - axis.bias)};
}

void settle(AxisObserver& axis, double& zero, double measured, bool has_flown) {
  if (has_flown) {
    axis.place += 0.1 * (measured - zero - axis.place);
  } else {
    zero += (zero == 0 ? 1 : 0.1) * (measured - zero);
  }
}

void take_off(AxisObserver& axis, double& zero) {
  zero += axis.place;
  axis.place = 0;
}

void rest(SlowAngle& slow, double measured, double rate) {
  slow = {.angle = measured, .bias = slow.bias + 0.02 * (rate - slow.bias)};
}

void learn(GroundPressure& ground, double pressure, double last) {
  ground.readings = std::min(ground.readings + 1, 200U);
  if (ground.readings == 1) {
    ground.mean = pressure;
    return;
  }
  ground.mean += 0.1 * (pressure - ground.mean);
  const double step = limited(pressure - last, 20);  // one gust is no noise
  ground.step_squared += (step * step - ground.step_squared) / (ground.readings - 1);
}

}  // namespace jarol::tasks
