// The helicopter's flight logic, driven through its states by an operator's key and what it is told of the flight.
#pragma once

#include <doctest/doctest.h>

#include <chrono>
#include <cstdint>

#include "tasks/javiator/flight_logic.h"

namespace jarol::tests {
struct Logic {
  tasks::FlightLogic::State state{};
  tasks::FlightLogic::Out out{};
  tasks::FlightLogic::In in{.estimate = {.battery = 15,
                                         .rates_known = true,
                                         .attitude_known = true,
                                         .altitude_known = true,
                                         .position_known = true,
                                         .pressure_known = true,
                                         .answers_known = true},
                            .lift = {1}};

  tasks::FlightLogic::Param param{.yaw_limit = 2};
  std::int64_t activation = 0;

  tasks::FlightState run(int periods) {
    for (int i = 0; i < periods; ++i)
      tasks::FlightLogic::run(param, {.activation = activation++, .period = std::chrono::milliseconds(15)}, in, state,
                              out);
    return out.directive.state;
  }
  tasks::FlightState press() {
    ++in.command.state_switches;
    return run(1);
  }
  void fly() {
    press();
    press();
    run(101);
    in.estimate.altitude = 1;
    in.command.altitude = 1;
    CHECK(run(1) == tasks::FlightState::flying);
  }
};

}  // namespace jarol::tests
