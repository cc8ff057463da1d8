// The helicopter's law of altitude in hover, for tests.
#pragma once

#include "tasks/javiator/altitude_control.h"
#include "tests/tasks/javiator/every_15_ms.h"

namespace jarol::tests {

/// Hovering at 1 m.
struct Altitude {
  tasks::AltitudeControl::State state{.z = {.place = 1}, .trim = 1, .mean_trim = 1, .aloft = 1, .lifted = true};
  tasks::AltitudeControl::Out out{};
  tasks::AltitudeControl::In in{.estimate = {.altitude = 1,
                                             .lift = g_earth,
                                             .rates_known = true,
                                             .attitude_known = true,
                                             .altitude_known = true,
                                             .answers_known = true},
                                .directive = {.state = tasks::FlightState::flying, .altitude = 1}};

  double run(int periods = 1) {
    for (int i = 0; i < periods; ++i) tasks::AltitudeControl::run({}, tick, in, state, out);
    return out.lift.thrust;
  }
};

}  // namespace jarol::tests
