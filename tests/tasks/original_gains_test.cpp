// Gains that the operator changes in flight, by hand computations.
#include <doctest/doctest.h>

#include "tasks/javiator/original_control.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;

Tick tick_of(std::int64_t activation) { return {.now = activation * 15ms, .activation = activation, .period = 15ms}; }
}  // namespace

TEST_SUITE("tasks/original_gains") {
  TEST_CASE("roll and yaw demand what the gains that were sent make of the error; pitch follows roll's") {
    OriginalAttitude::State state;
    OriginalAttitude::Out out;
    // 1 mrad, reached in a period of 15 ms
    OriginalAttitude::In in{.goal = {.roll = 1e-3, .pitch = 1e-3, .yaw = 1e-3}};
    OriginalAttitude::run({}, tick_of(0), in, state, out);
    CHECK(8000 * out.turn.roll == doctest::Approx(1.7 + 0.5 / 0.015));
    state = {};
    in.gains.lean = {{.kp = 3.4, .kd = 0.25}, true};
    OriginalAttitude::run({}, tick_of(0), in, state, out);
    CHECK(8000 * out.turn.roll == doctest::Approx(3.4 + 0.25 / 0.015));
    CHECK(out.turn.pitch == out.turn.roll);
    CHECK(8000 * out.turn.yaw == doctest::Approx(1.5 + 0.5 / 0.015));
    state = {};
    in.gains.yaw = {{.kp = -1}, true};
    OriginalAttitude::run({}, tick_of(0), in, state, out);
    CHECK(8000 * out.turn.yaw == doctest::Approx(-1));
  }

  TEST_CASE("gains count from the activation on that has them; the integral goes on") {
    OriginalAttitude::State state;
    OriginalAttitude::Out out;
    OriginalAttitude::In in{.goal = {.yaw = 0.1}};
    in.gains.yaw = {{.ki = 1}, true};
    for (int i = 0; i < 100; ++i) OriginalAttitude::run({}, tick_of(i), in, state, out);
    CHECK(8000 * out.turn.yaw == doctest::Approx(100 * 100 * 0.015));
    in.gains.yaw.gains = {.kp = 2, .ki = 0.5};
    OriginalAttitude::run({}, tick_of(100), in, state, out);
    CHECK(8000 * out.turn.yaw == doctest::Approx(2 * 100 + 0.5 * 101 * 100 * 0.015));
  }

  TEST_CASE("altitude: 100 mm too low at kp 2 makes 200 more than the idle signal, which may be sent too") {
    OriginalAltitude::State state;
    OriginalAltitude::Out out;
    OriginalAltitude::In in{.estimate = {.altitude = 0.9}, .directive = {.altitude = 1}};
    OriginalAltitude::run({}, tick_of(0), in, state, out);  // on the ground: takes up the goal
    in.directive.state = FlightState::flying;
    in.gains.altitude = {{.kp = 2}, true};
    OriginalAltitude::run({}, tick_of(1), in, state, out);
    CHECK(8000 * out.lift.thrust == doctest::Approx(8200));
    in.gains.idle = {7000, true};
    OriginalAltitude::run({}, tick_of(2), in, state, out);
    CHECK(8000 * out.lift.thrust == doctest::Approx(7200));
  }

  TEST_CASE("a metre from its place it leans 100 mrad at kp 0.1") {
    OriginalPosition::State state;
    OriginalPosition::Out out;
    OriginalPosition::In in{.directive = {.state = FlightState::flying, .hold_position = true, .y = 1}};
    in.gains.position = {{.kp = 0.1}, true};
    OriginalPosition::run({}, tick_of(0), in, state, out);
    CHECK(out.goal.roll == doctest::Approx(0.1));
  }

  TEST_CASE("flight starts from the idle signal that was sent") {
    OriginalLogic::State state;
    OriginalLogic::Out out;
    OriginalLogic::In in;
    in.gains.idle = {1000, true};
    for (std::uint32_t switches : {1U, 2U}) {
      in.command.state_switches = switches;
      OriginalLogic::run({}, tick_of(0), in, state, out);
    }
    for (int i = 1; i < 20; ++i) OriginalLogic::run({}, tick_of(i), in, state, out);
    CHECK(out.directive.state == FlightState::starting);
    OriginalLogic::run({}, tick_of(20), in, state, out);
    CHECK(out.directive.state == FlightState::flying);
  }
}
