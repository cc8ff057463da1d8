// What the helicopter's four sonars show of level ground, and a filter that is told it without an IMU, for tests.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "graph/math/rotations.h"
#include "tasks/javiator/filter.h"
#include "tests/tasks/heard_helicopter.h"
#include "tests/tasks/javiator/every_15_ms.h"

namespace jarol::tests {

/// From a height (m) of the centre of gravity above the ground, each sonar 20 cm from the axis; roll and pitch in rad.
inline tasks::SonarRanges ranges_of(double roll, double pitch, double height, std::uint32_t readings = 1) {
  const Eigen::Matrix3d R = rotation_of(roll, pitch, 0);
  tasks::SonarRanges sonars{.readings = readings};
  const std::array<Eigen::Vector3d, 4> places{{{0.2, 0, 0.055}, {0, 0.2, 0.055}, {-0.2, 0, 0.055}, {0, -0.2, 0.055}}};
  for (std::size_t i = 0; i < 4; ++i) sonars.ranges[i] = (height - (R * places[i]).z()) / R(2, 2);
  return sonars;
}

/// A filter that hovers at 1 m and has lost its IMU, told of four ranges each period.
struct BlindAboveGround {
  HeardHelicopter heard;
  tasks::BlindMotion blind{.lift = g_earth, .known = true, .tilt_known = true};
  tasks::SonarRanges sonars = ranges_of(0, 0, 1.2);

  BlindAboveGround() {
    heard.lift_to(1);
    heard.sensors.new_imu = false;
    heard.run(10);
    blind_for(1);
  }
  const tasks::FlightEstimate& blind_for(int periods, bool are_new = true) {
    for (int i = 0; i < periods; ++i) {
      ++heard.sensors.answers;
      if (are_new) ++sonars.readings;
      tasks::JaviatorFilter::run(heard.param, tick, {heard.sensors, heard.directive, blind, sonars}, heard.state,
                                 heard.out);
    }
    return heard.out.estimate;
  }
};

}  // namespace jarol::tests
