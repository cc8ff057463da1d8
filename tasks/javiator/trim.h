// The operator's trim: what roll and pitch count as level.
#pragma once

#include "graph/math/geometry.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

struct TrimKeys {
  std::uint32_t stores = 0, clears = 0;
  bool begun = false;

  static constexpr auto fields() {
    return describe(field<&TrimKeys::stores>(), field<&TrimKeys::clears>(),
                    field<&TrimKeys::begun>("", "with the trim of the flight before"));
  }
};

/// Of what may be stored (rad, to either side): a helicopter that hovers at a larger lean has something else.
inline constexpr double default_max_trim = 0.1;

/// Follows the operator's keys; `pressed` is what they were up to now.
inline void trim(const PilotCommand& command, const FlightEstimate& estimate, double max_trim, TrimKeys& pressed,
                 FlightDirective& d) {
  if (!pressed.begun) {
    d.trim_roll = limited(command.kept_trim_roll, max_trim);
    d.trim_pitch = limited(command.kept_trim_pitch, max_trim);
  }
  if (command.trim_clears != pressed.clears) d.trim_roll = d.trim_pitch = 0;
  if (command.trim_stores != pressed.stores) {
    // the estimate is already less the trim before
    d.trim_roll = limited(d.trim_roll + estimate.roll, max_trim);
    d.trim_pitch = limited(d.trim_pitch + estimate.pitch, max_trim);
  }
  pressed = {command.trim_stores, command.trim_clears, true};
}

}  // namespace jarol::tasks
