// From the helicopter's raw sensors to how it moves.
#pragma once

#include <string_view>

#include "graph/task.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

/// One axis of a fixed-gain observer: acceleration is integrated, and each measurement corrects place, speed and the
/// bias of the accelerometer.
struct AxisObserver {
  double place = 0, speed = 0, bias = 0;
  double silent = 0;

  static constexpr auto fields() {
    using A = AxisObserver;
    return describe(field<&A::place>("m"), field<&A::speed>("m/s"), field<&A::bias>("m/s^2", "of the accelerometer"),
                    field<&A::silent>("s", "since the last measurement"));
  }
};

struct JaviatorFilter {
  static constexpr std::string_view summary = "estimates attitude, position and velocity from the helicopter's sensors";
  struct Param {
    double sonar_x = 0, sonar_y = 0, sonar_z = 0.055;
    double laser_x_x = 0.070, laser_x_y = -0.075, laser_x_z = -0.080;
    double laser_y_x = -0.050, laser_y_y = 0.077, laser_y_z = -0.080;
    double bandwidth = 6;
    double age = 0.02;
    double patience = 0.3;
    double jump = 0.3;
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::sonar_x>("m", "of the sonar, forward of the centre of gravity"), field<&P::sonar_y>("m", "right"),
          field<&P::sonar_z>("m", "down"), field<&P::laser_x_x>("m", "of the laser to the north, forward"),
          field<&P::laser_x_y>("m", "right"), field<&P::laser_x_z>("m", "down"),
          field<&P::laser_y_x>("m", "of the laser to the east, forward"), field<&P::laser_y_y>("m", "right"),
          field<&P::laser_y_z>("m", "down"), field<&P::bandwidth>("rad/s", "of the observers of place and speed"),
          field<&P::age>("s", "of the attitude when it is used; it is turned on by the rates"),
          field<&P::patience>("s", "without a new measurement before a sensor counts as lost"),
          field<&P::jump>("m", "from the estimate at which a range is taken for an outlier"));
    }
  };
  struct In {
    JaviatorSensors sensors{};
    FlightDirective directive{};
    static constexpr auto fields() {
      return describe(field<&In::sensors>(), field<&In::directive>("", "of the period before"));
    }
  };
  struct State {
    AxisObserver x{}, y{}, z{};
    double zero_x = 0, zero_y = 0, zero_z = 0, zero_yaw = 0, zero_pressure = 0;
    double yaw = 0;
    double imu_silent = 0;
    std::uint32_t answers = 0;
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::x>(), field<&S::y>(), field<&S::z>("", "upwards"),
                      field<&S::zero_x>("m", "measured where it stands"), field<&S::zero_y>("m"),
                      field<&S::zero_z>("m"), field<&S::zero_yaw>("rad"), field<&S::zero_pressure>("Pa"),
                      field<&S::yaw>("rad", "all turns counted"), field<&S::imu_silent>("s", "since the IMU answered"),
                      field<&S::answers>("", "of the Robostix, up to now"));
    }
  };
  struct Out {
    FlightEstimate estimate{};
    static constexpr auto fields() { return describe(field<&Out::estimate>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

}  // namespace jarol::tasks
