// Messages of the IMC set (DUNE, Neptus) with their wire types; numbers and fields from the public IMC definition 5.4.
#pragma once

#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::messages::imc {

/// Id 50: the true state of a simulated vehicle. Offset from the origin in NED, Euler angles ZYX, body velocities.
struct SimulatedState {
  static constexpr std::uint16_t id = 50;
  double lat = 0, lon = 0;
  float height = 0;
  float x = 0, y = 0, z = 0;
  float phi = 0, theta = 0, psi = 0;
  float u = 0, v = 0, w = 0;
  float p = 0, q = 0, r = 0;
  float svx = 0, svy = 0, svz = 0;

  static constexpr auto fields() {
    using S = SimulatedState;
    return describe(field<&S::lat>("rad", "latitude of the origin (WGS-84)"),
                    field<&S::lon>("rad", "longitude of the origin"), field<&S::height>("m", "height of the origin"),
                    field<&S::x>("m", "offset north"), field<&S::y>("m", "offset east"),
                    field<&S::z>("m", "offset down"), field<&S::phi>("rad", "roll"), field<&S::theta>("rad", "pitch"),
                    field<&S::psi>("rad", "yaw"), field<&S::u>("m/s", "surge, through the water"),
                    field<&S::v>("m/s", "sway, through the water"), field<&S::w>("m/s", "heave, through the water"),
                    field<&S::p>("rad/s", "roll rate"), field<&S::q>("rad/s", "pitch rate"),
                    field<&S::r>("rad/s", "yaw rate"), field<&S::svx>("m/s", "current north"),
                    field<&S::svy>("m/s", "current east"), field<&S::svz>("m/s", "current down"));
  }
};

/// Id 301: commanded actuation of a thruster, from -1 (full astern) to 1 (full ahead).
struct SetThrusterActuation {
  static constexpr std::uint16_t id = 301;
  std::uint8_t thruster = 0;  // field "id" of the definition
  float value = 0;

  static constexpr auto fields() {
    using S = SetThrusterActuation;
    return describe(field<&S::thruster>("", "number of the thruster"), field<&S::value>("", "actuation, -1 to 1"));
  }
};

/// Id 302: commanded angle of a servo.
struct SetServoPosition {
  static constexpr std::uint16_t id = 302;
  std::uint8_t servo = 0;  // field "id" of the definition
  float value = 0;

  static constexpr auto fields() {
    using S = SetServoPosition;
    return describe(field<&S::servo>("", "number of the servo"), field<&S::value>("rad", "commanded angle"));
  }
};

}  // namespace jarol::messages::imc
