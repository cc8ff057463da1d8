// What the helicopter's Robostix reports and takes: body frame forward-right-down, SI units, radians. Roll to the
// right, pitch nose up, yaw clockwise are positive.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::tasks {

/// What the vehicle's sensors report, one answer of the Robostix.
struct JaviatorSensors {
  double roll = 0, pitch = 0, yaw = 0;
  double p = 0, q = 0, r = 0;
  double a_x = 0, a_y = 0, a_z = 0;
  double sonar = 0, laser_x = 0, laser_y = 0;
  double pressure = 0, temperature = 0, battery = 0;
  bool new_imu = false, new_bmu = false, new_sonar = false, new_x = false, new_y = false;
  std::uint32_t answers = 0, answered = 0;

  static constexpr auto fields() {
    using S = JaviatorSensors;
    return describe(field<&S::roll>("rad"), field<&S::pitch>("rad"), field<&S::yaw>("rad", "from north, -pi to pi"),
                    field<&S::p>("rad/s", "rate about the body's x"), field<&S::q>("rad/s", "about y"),
                    field<&S::r>("rad/s", "about z"), field<&S::a_x>("m/s^2", "specific force along the body's x"),
                    field<&S::a_y>("m/s^2", "along y"), field<&S::a_z>("m/s^2", "along z, -9.81 at rest"),
                    field<&S::sonar>("m", "range below"), field<&S::laser_x>("m", "range ahead, 0: nothing seen"),
                    field<&S::laser_y>("m", "range to the right, likewise"), field<&S::pressure>("Pa", "of the air"),
                    field<&S::temperature>("degC", "of the air"), field<&S::battery>("V", "voltage"),
                    field<&S::new_imu>("", "attitude, rates and forces are new"),
                    field<&S::new_bmu>("", "pressure, temperature and battery are new"),
                    field<&S::new_sonar>("", "sonar is new"), field<&S::new_x>("", "laser_x is new"),
                    field<&S::new_y>("", "laser_y is new"),
                    field<&S::answers>("", "answers so far; the same number again: none has come since"),
                    field<&S::answered>("", "number of the signals that it answers, 0: not known"));
  }
};

/// What each of its four sonars reports, for who has asked for it; one on each arm, in the order of the motors.
struct SonarRanges {
  std::array<double, 4> ranges{};
  std::uint32_t readings = 0;

  static constexpr auto fields() {
    return describe(field<&SonarRanges::ranges>("m", "along the body's axis, of the front, right, rear and left one"),
                    field<&SonarRanges::readings>("", "so far; the same number again: none has come since"));
  }
};

/// As the Robostix takes them.
inline constexpr double max_motor_signal = 16000;

/// Motor signals in the order front, right, rear, left; the Robostix obeys them while unlocked.
struct MotorCommand {
  std::array<double, 4> signals{};
  bool unlocked = false;
  std::uint32_t number = 0;

  static constexpr auto fields() {
    return describe(field<&MotorCommand::signals>("").in(0, max_motor_signal),
                    field<&MotorCommand::unlocked>("", "motors may turn"),
                    field<&MotorCommand::number>("", "of these signals, 0: none; who answers them repeats it"));
  }
};

}  // namespace jarol::tasks
