// How deep, fast and wide the submarine's operator may send it.
#pragma once

#include <string_view>

#include "graph/values/type_of.h"
#include "tasks/values/guidance.h"

namespace jarol::distributers {

/// Defaults: the limits of the vehicle's supervisor, as specs/exolauv.yaml has it, and what the propeller reaches. A
/// plan beyond them is refused before it begins, and a DesiredZ brought within them.
struct FlightLimits {
  double max_depth = 12;
  double min_altitude = 2;
  double margin = 0.5;
  double min_speed = 0.2;
  double max_speed = 2;
  double min_thrust = 0.1;
  double max_radius = 1000;

  static constexpr auto fields() {
    using L = FlightLimits;
    return describe(field<&L::max_depth>("m", "limit that the vehicle's supervisor keeps"),
                    field<&L::min_altitude>("m", "the same, over the sea floor"),
                    field<&L::margin>("m", "that plans keep to both, as the vehicle overshoots"),
                    field<&L::min_speed>("m/s", "of a plan"), field<&L::max_speed>("m/s", "of a plan"),
                    field<&L::min_thrust>("", "of a plan whose speeds are in %, 0 to 1"),
                    field<&L::max_radius>("m", "of a circle or a station"));
  }
};

/// Throw InputError that says what is beyond a limit, and what would be within. `what` names the value.
void check_level(const FlightLimits& limits, tasks::Vertical from, double level, std::string_view what);
void check_speed(const FlightLimits& limits, double speed);            // m/s
void check_percentage(const FlightLimits& limits, double percentage);  // of thrust
void check_radius(const FlightLimits& limits, double radius, std::string_view what);

}  // namespace jarol::distributers
