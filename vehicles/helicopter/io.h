// What goes into the helicopter and comes out of it.
#pragma once

#include <limits>
#include <vector>

#include "distributers/interfaces/vehicle.h"
#include "graph/values/describe.h"

namespace jarol::vehicles {

struct HelicopterInputs {
  double front = 0.0;
  double right = 0.0;
  double rear = 0.0;
  double left = 0.0;

  static std::vector<Range> ranges() {
    constexpr Range signal{0, 16000};
    return {signal, signal, signal, signal};
  }

  static constexpr auto fields() {
    using S = HelicopterInputs;
    return describe(field<&S::front>("", "motor signal, front rotor"),
                    field<&S::right>("", "motor signal, right rotor"), field<&S::rear>("", "motor signal, rear rotor"),
                    field<&S::left>("", "motor signal, left rotor"));
  }
};

/// Signals that the rotors have reached at the reference voltage.
struct HelicopterRotors {
  double front = 0.0;
  double right = 0.0;
  double rear = 0.0;
  double left = 0.0;

  static constexpr auto fields() {
    using S = HelicopterRotors;
    return describe(field<&S::front>("", "signal that the front rotor has reached, 0 to 16000"),
                    field<&S::right>("", "the same of the right rotor"),
                    field<&S::rear>("", "the same of the rear rotor"),
                    field<&S::left>("", "the same of the left rotor"));
  }
};

struct HelicopterBattery {
  double voltage = 0.0;
  double current = 0.0;

  static constexpr auto fields() {
    using S = HelicopterBattery;
    return describe(field<&S::voltage>("V", "voltage of the battery"), field<&S::current>("A", "drawn from it"));
  }
};

/// What the Robostix has answered last, in SI units; NaN until it answers.
struct HelicopterReadings {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double roll = none, pitch = none, yaw = none;
  double droll = none, dpitch = none, dyaw = none;
  double ddx = none, ddy = none, ddz = none;
  double sonar = none, x_laser = none, y_laser = none;
  double pressure = none, temperature = none, voltage = none;

  static constexpr auto fields() {
    using S = HelicopterReadings;
    return describe(
        field<&S::roll>("rad", "3DM-GX1"), field<&S::pitch>("rad", "3DM-GX1"),
        field<&S::yaw>("rad", "3DM-GX1, from north"), field<&S::droll>("rad/s", "3DM-GX1, rate about x"),
        field<&S::dpitch>("rad/s", "3DM-GX1, rate about y"), field<&S::dyaw>("rad/s", "3DM-GX1, rate about z"),
        field<&S::ddx>("m/s^2", "3DM-GX1, specific force along x"),
        field<&S::ddy>("m/s^2", "3DM-GX1, specific force along y"),
        field<&S::ddz>("m/s^2", "3DM-GX1, specific force along z, -9.81 at rest"),
        field<&S::sonar>("m", "range to the ground"), field<&S::x_laser>("m", "range to the wall in the north"),
        field<&S::y_laser>("m", "range to the wall in the east"), field<&S::pressure>("Pa", "of the air"),
        field<&S::temperature>("degC", "of the air"), field<&S::voltage>("V", "of the battery"));
  }
};

struct HelicopterOutputs {
  HelicopterRotors rotors{};
  HelicopterBattery battery{};
  HelicopterReadings sensors{};

  static constexpr auto fields() {
    using S = HelicopterOutputs;
    return describe(field<&S::rotors>("", "what the rotors do"), field<&S::battery>("", "what the battery gives"),
                    field<&S::sensors>("", "what the sensors report"));
  }
};

}  // namespace jarol::vehicles
