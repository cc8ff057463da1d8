// Packets between the JAviator's flight controller and its Robostix, with their wire types; ids, fields and scales as
// in the JAviator project's protocol and control loop.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::messages::javiator {

/// Id 0x02, the long form: what the Robostix answers to motor signals, in raw units of its sensors. Body axes are
/// forward, right, down.
struct JaviatorData {
  static constexpr std::uint8_t id_number = 0x02;
  std::uint32_t maps = 0;
  std::uint16_t temp = 0, batt = 0, sonar = 0, state = 0, id = 0;
  std::array<std::uint8_t, 8> x_pos{}, y_pos{};
  std::int16_t roll = 0, pitch = 0, yaw = 0;
  std::int16_t droll = 0, dpitch = 0, dyaw = 0;
  std::int16_t ddx = 0, ddy = 0, ddz = 0;

  // bits of `state`: what has been measured since the packet before
  static constexpr std::uint16_t new_imu = 1, new_bmu = 2, new_sonar = 4, new_x = 8, new_y = 16;

  static constexpr auto fields() {
    using S = JaviatorData;
    return describe(field<&S::maps>("115e6/2^24 mPa", "air pressure, 24 bit"),
                    field<&S::temp>("10000/4096 cdegC", "temperature, 700 cdegC too high"),
                    field<&S::batt>("18000/1024 mV", "voltage of the battery, 10 bit"),
                    field<&S::sonar>("3000/1024 mm", "range of the sonar, 10 bit"),
                    field<&S::state>("", "what is new: 1 IMU, 2 BMU, 4 sonar, 8 x, 16 y"),
                    field<&S::id>("", "that of the motor signals answered"),
                    field<&S::x_pos>("mm", "range of the x laser: seven ASCII digits and a NUL"),
                    field<&S::y_pos>("mm", "range of the y laser: seven ASCII digits and a NUL"),
                    field<&S::roll>("2000 pi/65536 mrad"), field<&S::pitch>("2000 pi/65536 mrad"),
                    field<&S::yaw>("2000 pi/65536 mrad"), field<&S::droll>("8500/32768 mrad/s", "rate about x"),
                    field<&S::dpitch>("8500/32768 mrad/s", "rate about y"),
                    field<&S::dyaw>("8500/32768 mrad/s", "rate about z"),
                    field<&S::ddx>("9810/4681 mm/s^2", "specific force along x"),
                    field<&S::ddy>("9810/4681 mm/s^2", "specific force along y"),
                    field<&S::ddz>("9810/4681 mm/s^2", "specific force along z, -4681 at rest"));
  }
};

/// Id 0x05: signals for the four motors, 0 to 16000.
struct MotorSignals {
  static constexpr std::uint8_t id_number = 0x05;
  std::int16_t front = 0, right = 0, rear = 0, left = 0;
  std::uint16_t id = 0;

  static constexpr auto fields() {
    using S = MotorSignals;
    return describe(field<&S::front>(), field<&S::right>(), field<&S::rear>(), field<&S::left>(),
                    field<&S::id>("", "comes back in the answer"));
  }
};

/// Id 0x11: unlocks the motors.
struct SwitchState {
  static constexpr std::uint8_t id_number = 0x11;
  static constexpr auto fields() { return describe(); }
};

/// Id 0x15: stops the motors and locks them.
struct ShutDown {
  static constexpr std::uint8_t id_number = 0x15;
  static constexpr auto fields() { return describe(); }
};

}  // namespace jarol::messages::javiator
