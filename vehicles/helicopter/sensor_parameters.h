// Parameters of the helicopter's sensors: where they are, how well they measure, and when they fail.
#pragma once

#include <cstdint>

#include "graph/values/describe.h"
#include "vehicles/mechanics/actuator_failure.h"
#include "vehicles/sensors/sensor_failure.h"

namespace jarol::vehicles {

/// Places of the sensors in body axes, and the room they measure. Two lasers are fixed to the body, one looks forward
/// and one to the right: north and east at heading 0. They see the walls, whatever their height, and nothing else; a
/// reading of 0 is that of nothing within reach. Four sonars are spread evenly about the vehicle's axis, and the mean
/// of the middle two counts; who asks is told what each reports.
struct SensorParameters {
  std::uint8_t sonars = 4;
  double sonar_x = 0.20;
  double sonar_y = 0.0;
  double sonar_z = 0.055;
  double wall_north = 8.0;
  double wall_east = 8.0;
  double wall_south = 12.0;
  double wall_west = 12.0;
  double laser_reach = 100.0;
  double laser_north_x = -0.070;
  double laser_north_y = 0.075;
  double laser_north_z = 0.080;
  double laser_east_x = 0.050;
  double laser_east_y = -0.077;
  double laser_east_z = 0.080;
  double temperature = 25.0;
  double pressure = 101325.0;

  static constexpr auto fields() {
    using S = SensorParameters;
    return describe(field<&S::sonars>("", "1 or 4"), field<&S::sonar_x>("m", "of the first sonar, forward"),
                    field<&S::sonar_y>("m", "of the first sonar, right"),
                    field<&S::sonar_z>("m", "of the sonars, down"), field<&S::wall_north>("m", "north of the origin"),
                    field<&S::wall_east>("m", "east of the origin"), field<&S::wall_south>("m", "south of the origin"),
                    field<&S::wall_west>("m", "west of the origin"),
                    field<&S::laser_reach>("m", "beyond which a laser sees nothing"),
                    field<&S::laser_north_x>("m", "of the laser that looks forward, forward"),
                    field<&S::laser_north_y>("m", "of the laser that looks forward, right"),
                    field<&S::laser_north_z>("m", "of the laser that looks forward, down"),
                    field<&S::laser_east_x>("m", "of the laser that looks right, forward"),
                    field<&S::laser_east_y>("m", "of the laser that looks right, right"),
                    field<&S::laser_east_z>("m", "of the laser that looks right, down"),
                    field<&S::temperature>("degC", "of the air"),
                    field<&S::pressure>("Pa", "of the air where the vehicle stands at rest"));
  }
};

/// Standard deviations: of each measurement, of the biases at the start, and of how far these wander.
struct NoiseParameters {
  double attitude = 0.0;
  double rate = 0.0;
  double rate_bias = 0.0;
  double rate_drift = 0.0;
  double force = 0.0;
  double force_bias = 0.0;
  double force_drift = 0.0;
  double sonar = 0.0;
  double sonar_outliers = 0.0;
  double laser = 0.0;
  double pressure = 0.0;
  double voltage = 0.0;

  static constexpr auto fields() {
    using S = NoiseParameters;
    return describe(field<&S::attitude>("rad", "roll, pitch and yaw of the IMU"),
                    field<&S::rate>("rad/s", "rates of the IMU"), field<&S::rate_bias>("rad/s", "their biases"),
                    field<&S::rate_drift>("rad/s", "by which these have wandered after 100 s"),
                    field<&S::force>("m/s^2", "specific forces of the IMU"),
                    field<&S::force_bias>("m/s^2", "their biases"),
                    field<&S::force_drift>("m/s^2", "by which these have wandered after 100 s"),
                    field<&S::sonar>("m", "each sonar"),
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
  ActuatorFailure front{};
  ActuatorFailure right{};
  ActuatorFailure rear{};
  ActuatorFailure left{};

  static constexpr auto fields() {
    using S = FailureParameters;
    return describe(field<&S::imu>("", "attitude, rates and forces; an amount is of the roll, rad"),
                    field<&S::sonar>("", "all sonars; an amount is in m"),
                    field<&S::laser_north>("", "the laser that looks forward, m"),
                    field<&S::laser_east>("", "the laser that looks right, m"),
                    field<&S::bmu>("", "pressure, temperature and battery; an amount is of the pressure, Pa"),
                    field<&S::front>("", "motor"), field<&S::right>("", "motor"), field<&S::rear>("", "motor"),
                    field<&S::left>("", "motor"));
  }
};

}  // namespace jarol::vehicles
