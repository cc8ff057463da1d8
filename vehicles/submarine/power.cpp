#include "vehicles/submarine/power.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/text/errors.h"

namespace jarol::vehicles {

Power::Power(const PowerParameters& p) : parameters_(p), used_(3600.0 * (1.0 - p.charge) * p.capacity) {
  if (!(p.capacity > 0.0)) throw InputError("submarine: power.capacity must be above zero");
  if (!(p.resistance >= 0.0)) throw InputError("submarine: power.resistance is below zero");
  if (!(p.empty <= p.full))
    throw InputError(fmt::format("submarine: power.empty must not be above power.full, and is {} V where that is {} V",
                                 p.empty, p.full));
}

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
