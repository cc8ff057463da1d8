// Values that the submarine's tasks exchange. Earth frame NED, body frame forward-right-down, SI units, radians.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

#include "graph/values/describe.h"
#include "tasks/values/alarm.h"

namespace jarol::tasks {

/// How the vehicle moves, as its navigation reports it.
struct Motion {
  double x = 0, y = 0, z = 0;
  double phi = 0, theta = 0, psi = 0;
  double u = 0, v = 0, w = 0;
  double p = 0, q = 0, r = 0;

  static constexpr auto fields() {
    using M = Motion;
    return describe(field<&M::x>("m", "north of the origin"), field<&M::y>("m", "east of the origin"),
                    field<&M::z>("m", "below the surface"), field<&M::phi>("rad", "roll"),
                    field<&M::theta>("rad", "pitch, nose up"), field<&M::psi>("rad", "heading, -pi to pi"),
                    field<&M::u>("m/s", "surge, through the water"), field<&M::v>("m/s", "sway"),
                    field<&M::w>("m/s", "heave"), field<&M::p>("rad/s", "roll rate"),
                    field<&M::q>("rad/s", "pitch rate"), field<&M::r>("rad/s", "yaw rate"));
  }
};

/// Which of two commands steers.
enum class Turn : std::uint8_t { heading, rate };
enum class Drive : std::uint8_t { speed, thrust };

constexpr auto enumerators(Turn) {
  return std::array<Enumerator<Turn>, 2>{{{"heading", Turn::heading}, {"rate", Turn::rate}}};
}
constexpr auto enumerators(Drive) {
  return std::array<Enumerator<Drive>, 2>{{{"speed", Drive::speed}, {"thrust", Drive::thrust}}};
}

/// What the operator wants: a heading or a rate of turn, a speed or a thrust.
struct Setpoint {
  double depth = 0;
  double heading = 0;
  double speed = 0;
  Turn turn = Turn::heading;
  double rate = 0;
  Drive drive = Drive::speed;
  double thrust = 0;

  static constexpr auto fields() {
    using S = Setpoint;
    return describe(field<&S::depth>("m", "below the surface"), field<&S::heading>("rad", "clockwise from north"),
                    field<&S::speed>("m/s", "through the water, 0 stops the propeller"),
                    field<&S::turn>("", "what steers: heading or rate"), field<&S::rate>("rad/s", "to starboard"),
                    field<&S::drive>("", "what drives: speed or thrust"),
                    field<&S::thrust>("", "-1 (full astern) to 1 (full ahead)"));
  }
};

/// What the operator is sent.
struct VehicleReport {
  double depth = 0;
  double pitch = 0;
  double heading = 0;
  double speed = 0;
  Alarm alarm = Alarm::none;
  FinCheck fins = FinCheck::checked;

  static constexpr auto fields() {
    using S = VehicleReport;
    return describe(field<&S::depth>("m", "below the surface"), field<&S::pitch>("rad", "nose up"),
                    field<&S::heading>("rad", "clockwise from north"), field<&S::speed>("m/s", "through the water"),
                    field<&S::alarm>("", "why it comes up, or none"),
                    field<&S::fins>("", "by what their servos report; which one has failed if that ends no dive"));
  }
};

/// As far as the fins of any LAUV turn.
inline constexpr double max_fin_angle = std::numbers::pi / 4;

/// A turning demand on the fins of one axis, in fin angle.
struct Moment {
  double angle = 0;

  static constexpr auto fields() {
    return describe(field<&Moment::angle>("rad", "of the fins, positive turns the axis' positive way")
                        .in(-max_fin_angle, max_fin_angle));
  }
};

/// A demand on the propeller.
struct Thrust {
  double actuation = 0;

  static constexpr auto fields() {
    return describe(field<&Thrust::actuation>("", "full astern to full ahead").in(-1, 1));
  }
};

/// What the actuators get: fins 0 bottom, 1 port, 2 starboard, 3 top; positive on 0 and 3 turns to port, positive on 1
/// and 2 noses down (the LAUV's numbering).
struct Actuation {
  double thruster = 0;
  std::array<double, 4> fins{};

  static constexpr auto fields() {
    using A = Actuation;
    return describe(field<&A::thruster>("", "-1 to 1"), field<&A::fins>("rad", "commanded angles"));
  }
};

}  // namespace jarol::tasks
