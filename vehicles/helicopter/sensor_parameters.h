// Parameters of the helicopter's sensors: where they are, how well they measure, and when they fail.
#pragma once

#include <cstdint>

#include "graph/values/describe.h"
#include "vehicles/sensors/sensor_failure.h"

namespace jarol::vehicles {

/// Places of the sensors in body axes. Lasers measure to walls north and east. Four sonars are spread evenly about the
/// vehicle's axis, and the mean of the middle two counts.
struct SensorParameters {
  std::uint8_t sonars = 4;
  double sonar_x = 0.20;
  double sonar_y = 0.0;
  double sonar_z = 0.055;
  double wall_north = 8.0;
  double wall_east = 8.0;
  double laser_north_x = 0.070;
  double laser_north_y = -0.075;
  double laser_north_z = -0.080;
  double laser_east_x = -0.050;
  double laser_east_y = 0.077;
  double laser_east_z = -0.080;
  double temperature = 25.0;
  double pressure = 101325.0;

  static constexpr auto fields() {
    using S = SensorParameters;
    return describe(field<&S::sonars>("", "1 or 4"), field<&S::sonar_x>("m", "of the first sonar, forward"),
                    field<&S::sonar_y>("m", "of the first sonar, right"),
                    field<&S::sonar_z>("m", "of the sonars, down"), field<&S::wall_north>("m", "north of the origin"),
                    field<&S::wall_east>("m", "east of the origin"),
                    field<&S::laser_north_x>("m", "of the laser that looks north, forward"),
                    field<&S::laser_north_y>("m", "of the laser that looks north, right"),
                    field<&S::laser_north_z>("m", "of the laser that looks north, down"),
                    field<&S::laser_east_x>("m", "of the laser that looks east, forward"),
                    field<&S::laser_east_y>("m", "of the laser that looks east, right"),
                    field<&S::laser_east_z>("m", "of the laser that looks east, down"),
                    field<&S::temperature>("degC", "of the air"),
                    field<&S::pressure>("Pa", "of the air where the vehicle stands at rest"));
  }
};

/// Standard deviations: of each measurement, and of the biases, which are drawn once for a run.
struct NoiseParameters {
  double attitude = 0.0;
  double rate = 0.0;
  double rate_bias = 0.0;
  double force = 0.0;
  double force_bias = 0.0;
  double sonar = 0.0;
  double sonar_outliers = 0.0;
  double laser = 0.0;
  double pressure = 0.0;
  double voltage = 0.0;

  static constexpr auto fields() {
    using S = NoiseParameters;
    return describe(field<&S::attitude>("rad", "roll, pitch and yaw of the IMU"),
                    field<&S::rate>("rad/s", "rates of the IMU"), field<&S::rate_bias>("rad/s", "their biases"),
                    field<&S::force>("m/s^2", "specific forces of the IMU"),
                    field<&S::force_bias>("m/s^2", "their biases"), field<&S::sonar>("m", "each sonar"),
                    field<&S::sonar_outliers>("", "part of a sonar's readings that are anything within its range"),
                    field<&S::laser>("m", "lasers"), field<&S::pressure>("Pa", "pressure"),
                    field<&S::voltage>("V", "voltage of the battery"));
  }
};

struct FailureParameters {
  SensorFailure imu{};
  SensorFailure sonar{};
  SensorFailure laser_north{};
  SensorFailure laser_east{};
  SensorFailure bmu{};

  static constexpr auto fields() {
    using S = FailureParameters;
    return describe(field<&S::imu>("", "attitude, rates and forces; a bias is of the roll, rad"),
                    field<&S::sonar>("", "all sonars; a bias is in m"), field<&S::laser_north>("", "a bias is in m"),
                    field<&S::laser_east>("", "a bias is in m"),
                    field<&S::bmu>("", "pressure, temperature and battery; a bias is of the pressure, Pa"));
  }
};

}  // namespace jarol::vehicles
