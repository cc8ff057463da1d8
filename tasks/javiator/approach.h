// A goal that is approached as fast as a vehicle can follow.
#pragma once

#include "graph/values/describe.h"

namespace jarol::tasks {

/// A goal approached with bounded speed, acceleration and jerk, without overshoot. What is demanded is felt a little
/// later, for rotors and attitude need their time: place and speed follow what is felt.
struct Approach {
  double place = 0, speed = 0, felt = 0, demand = 0;

  static constexpr auto fields() {
    using A = Approach;
    return describe(field<&A::place>("m"), field<&A::speed>("m/s"), field<&A::felt>("m/s^2"),
                    field<&A::demand>("m/s^2"));
  }
};

struct ApproachLimits {
  double bandwidth = 1;
  double speed = 1;
  double acceleration = 1;
  double jerk = 10;
  double lag = 0.1;

  static constexpr auto fields() {
    using L = ApproachLimits;
    return describe(field<&L::bandwidth>("rad/s", "near the goal"), field<&L::speed>("m/s", "greatest"),
                    field<&L::acceleration>("m/s^2", "greatest"), field<&L::jerk>("m/s^3", "greatest"),
                    field<&L::lag>("s", "until an acceleration demanded is felt"));
  }
};

/// One period on; critically damped, s^2 + 2 w s + w^2, but for its bounds.
void approach(Approach& a, double goal, const ApproachLimits& p, double dt);

}  // namespace jarol::tasks
