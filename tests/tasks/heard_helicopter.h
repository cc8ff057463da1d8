// What the helicopter's filter hears while it stands or hovers, for tests.
#pragma once

#include "tasks/javiator/filter.h"

namespace jarol::tests {

/// A filter with what it hears: level and at rest at an altitude, 15 ms a period, every sensor new each period.
struct HeardHelicopter {
  tasks::JaviatorFilter::Param param{.imu_repeats = 0, .laser_repeats = 0, .sonar_repeats = 0, .repeats = 0};
  tasks::JaviatorFilter::State state{};
  tasks::JaviatorFilter::Out out{};
  tasks::JaviatorSensors sensors{.a_z = -9.81,
                                 .sonar = 0.145,
                                 .laser_x = 8.07,
                                 .laser_y = 8.077,
                                 .pressure = 101325,
                                 .battery = 15,
                                 .new_imu = true,
                                 .new_bmu = true,
                                 .new_sonar = true,
                                 .new_x = true,
                                 .new_y = true};
  tasks::FlightDirective directive{.state = tasks::FlightState::ground};
  tasks::BlindMotion blind{};

  std::int64_t activation = 0;

  static constexpr double dt = 0.015;  // s

  const tasks::FlightEstimate& run(int periods) {
    for (int i = 0; i < periods; ++i) {
      ++sensors.answers;
      tasks::JaviatorFilter::run(param, {.activation = activation++, .period = std::chrono::milliseconds(15)},
                                 {sensors, directive, blind}, state, out);
    }
    return out.estimate;
  }

  // Takes off, and is lifted slowly to an altitude, as all sensors show.
  void lift_to(double altitude) {
    run(100);
    directive.state = tasks::FlightState::flying;
    for (int i = 1; i <= 200; ++i) {
      sensors.sonar = 0.145 + altitude * i / 200;
      sensors.pressure = 101325 - 12 * altitude * i / 200;
      run(1);
    }
    run(300);
  }
};

/// One that hovers at 1 m, all sensors agreeing.
inline HeardHelicopter hovering() {
  HeardHelicopter heard;
  heard.lift_to(1);
  return heard;
}

}  // namespace jarol::tests
