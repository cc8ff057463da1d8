// What the distributer and tasks exchange.
#pragma once

#include <jarol/task.h>

struct Pose {
  double x = 0;
  double y = 0;
  double heading = 0;
  static constexpr auto fields() {
    using jarol::field;
    return jarol::describe(field<&Pose::x>("m", "north of the start"), field<&Pose::y>("m", "east of the start"),
                           field<&Pose::heading>("rad", "from north to east"));
  }
};

struct Drive {
  double speed = 0;
  double turn = 0;
  static constexpr auto fields() {
    return jarol::describe(jarol::field<&Drive::speed>("m/s", "forward"),
                           jarol::field<&Drive::turn>("rad/s", "clockwise, seen from above"));
  }
};
