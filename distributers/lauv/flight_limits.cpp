#include "distributers/lauv/flight_limits.h"

#include <fmt/format.h>

#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

constexpr double rounding = 1 + 1e-6;  // what is written is a float

}  // namespace

void check_level(const FlightLimits& limits, tasks::Vertical from, double level, std::string_view what) {
  if (from == tasks::Vertical::depth) {
    if (const double max = limits.max_depth - limits.margin; !(level <= max * rounding))
      throw InputError(fmt::format("{} is {:.6g} m; depths are at most {:.6g} m", what, level, max));
  } else if (const double min = limits.min_altitude + limits.margin; !(level * rounding >= min)) {
    throw InputError(fmt::format("{} is {:.6g} m; altitudes are at least {:.6g} m", what, level, min));
  }
}

void check_speed(const FlightLimits& limits, double speed) {
  if (speed * rounding >= limits.min_speed && speed <= limits.max_speed * rounding) return;
  throw InputError(
      fmt::format("speed is {:.6g} m/s; speeds are {:.6g} to {:.6g} m/s", speed, limits.min_speed, limits.max_speed));
}

void check_percentage(const FlightLimits& limits, double percentage) {
  if (percentage >= 100 * limits.min_thrust && percentage <= 100) return;
  throw InputError(fmt::format("speed is {:.6g} %; these are {:.6g} to 100 %", percentage, 100 * limits.min_thrust));
}

void check_radius(const FlightLimits& limits, double radius, std::string_view what) {
  if (!(radius <= limits.max_radius * rounding))
    throw InputError(fmt::format("{} is {:.6g} m; it is at most {:.6g} m", what, radius, limits.max_radius));
}

}  // namespace jarol::distributers
