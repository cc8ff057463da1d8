#include "vehicles/submarine/power.h"

#include <algorithm>
#include <cmath>

namespace jarol::vehicles {

void Power::draw(double part, double seconds) {
  const double speed = std::abs(part);
  current_ = is_flat() ? 0.0 : parameters_.hotel + parameters_.propulsion * speed * speed * speed;
  used_ += current_ * seconds;
  warmth_ += (parameters_.heating * current_ - warmth_) * (1.0 - std::exp(-seconds / parameters_.heating_time));
}

double Power::voltage() const {
  if (is_flat()) return 0.0;
  const double used = used_ / (3600.0 * parameters_.capacity);
  return std::max(0.0,
                  parameters_.full - (parameters_.full - parameters_.empty) * used - parameters_.resistance * current_);
}

}  // namespace jarol::vehicles
