#include "vehicles/helicopter/battery.h"

#include <algorithm>

#include "graph/math/powers.h"

namespace jarol::vehicles {

double Battery::calc_current(const std::array<double, 4>& thrusts) const {
  double sum = 0.0;
  for (const double part : math::pow_each(thrusts, parameters_.current_exponent)) sum += part;
  return parameters_.electronics + 0.25 * parameters_.full_current * sum;
}

double Battery::calc_voltage(double current) const {
  const double used = used_ / (3600.0 * parameters_.capacity);
  if (used >= 1.0) return 0.0;
  return std::max(parameters_.full - (parameters_.full - parameters_.empty) * used - parameters_.resistance * current,
                  0.0);
}

}  // namespace jarol::vehicles
