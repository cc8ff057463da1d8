// Where a helicopter truly is, as its operator would name it.
#pragma once

#include "graph/values/describe.h"

namespace jarol::vehicles {

/// Angles, place and altitude are counted from the start, as the flight controller's are.
struct HelicopterTruth {
  double roll = 0, pitch = 0, yaw = 0;
  double x = 0, y = 0, altitude = 0;
  double climb = 0, speed = 0;
  double height = 0, tilt = 0, touch_down = 0, impact = 0;

  static constexpr auto fields() {
    using S = HelicopterTruth;
    return describe(
        field<&S::roll>("rad", "to the right"), field<&S::pitch>("rad", "nose up"),
        field<&S::yaw>("rad", "clockwise from the heading at the start, -pi to pi"),
        field<&S::x>("m", "north of the start"), field<&S::y>("m", "east of the start"),
        field<&S::altitude>("m", "above the start"), field<&S::climb>("m/s", "upwards"),
        field<&S::speed>("m/s", "over the ground"), field<&S::height>("m", "of the lowest foot above the ground"),
        field<&S::tilt>("rad", "of its axis from the vertical"),
        field<&S::touch_down>("m/s", "greatest speed down of its middle as a part of it met the ground so far"),
        field<&S::impact>("m/s", "greatest speed down of a part that met the ground so far"));
  }
};

}  // namespace jarol::vehicles
