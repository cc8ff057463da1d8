#include "tasks/javiator/control.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tasks/javiator/altitude_control.h"
#include "tests/tasks/javiator/every_15_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;

using tests::tick;

FlightEstimate level() { return {.lift = 9.81, .rates_known = true, .attitude_known = true}; }
}  // namespace

TEST_SUITE("tasks/javiator_control") {
  TEST_CASE("to the north it noses down, to the east it rolls right, whatever its heading") {
    PositionControl::State state;
    PositionControl::Out out;
    PositionControl::In in{.estimate = level(), .directive = {.state = FlightState::flying, .hold_position = true}};
    PositionControl::run({}, tick, in, state, out);
    in.directive.x = in.directive.y = 1;
    for (int i = 0; i < 10; ++i) PositionControl::run({}, tick, in, state, out);
    CHECK(out.goal.pitch < -0.05);
    CHECK(out.goal.roll > 0.05);
    in.estimate.heading = 1.5707963267948966;  // nose to the east: north is to the left
    for (int i = 0; i < 10; ++i) PositionControl::run({}, tick, in, state, out);
    CHECK(out.goal.pitch < -0.05);
    CHECK(out.goal.roll < -0.05);
  }

  TEST_CASE("it leans against drag, which its accelerometers feel") {
    PositionControl::State state;
    PositionControl::Out out;
    PositionControl::In in{.estimate = level(), .directive = {.state = FlightState::flying, .hold_position = true}};
    in.estimate.drag_x = 0.5;  // blown to the north
    for (int i = 0; i < 100; ++i) PositionControl::run({}, tick, in, state, out);
    CHECK(out.goal.pitch == doctest::Approx(std::atan(0.5 / 9.81)).scale(0).epsilon(1e-6));
  }

  TEST_CASE("by hand commands are meant from the take-off heading and bounded") {
    PositionControl::State state;
    PositionControl::Out out;
    PositionControl::In in{.estimate = level(), .directive = {.state = FlightState::flying, .roll = 0.1}};
    PositionControl::run({}, tick, in, state, out);
    CHECK(out.goal.roll == doctest::Approx(0.1));
    in.estimate.yaw = 1.5707963267948966;
    PositionControl::run({}, tick, in, state, out);
    CHECK(out.goal.pitch == doctest::Approx(-0.1));
    in.directive.roll = -2;
    PositionControl::run({}, tick, in, state, out);
    CHECK(out.goal.pitch == 0.4);
  }

  TEST_CASE("where it stands it levels in 0.3 s, holds no place, leans nowhere and turns nowhere") {
    PositionControl::State state{.holding = true};
    PositionControl::Out out{.goal = {.roll = 0.2, .pitch = -0.1}};
    PositionControl::In in{
        .estimate = level(),
        .directive = {
            .state = FlightState::flying, .hold_position = true, .stands = true, .roll = 0.3, .yaw = 1, .x = 4}};
    in.estimate.yaw = 0.2;
    for (int i = 0; i < 20; ++i) PositionControl::run({}, tick, in, state, out);
    CHECK(out.goal.roll == doctest::Approx(0.2 * std::pow(0.95, 20)));
    CHECK(out.goal.pitch == doctest::Approx(-0.1 * std::pow(0.95, 20)));
    CHECK(out.goal.yaw == 0.2);
    CHECK_FALSE(state.holding);
    in.directive.hold_position = false;
    PositionControl::run({}, tick, in, state, out);
    CHECK(out.goal.roll == doctest::Approx(0.2 * std::pow(0.95, 21)));
  }

  TEST_CASE("a turn that has begun by itself is resisted") {
    AttitudeControl::State state;
    AttitudeControl::Out out;
    AttitudeControl::In in{.estimate = level()};
    in.estimate.p = 0.5;
    in.estimate.r = -0.5;
    AttitudeControl::run({}, tick, in, state, out);
    CHECK(out.turn.roll < -0.03);
    CHECK(out.turn.pitch == 0);
    CHECK(out.turn.yaw > 0.005);
  }

  TEST_CASE("thrust that is lost is made up for as soon as it is felt") {
    AltitudeControl::State state{.z = {.place = 1}, .trim = 1, .mean_trim = 1, .lifted = true};
    AltitudeControl::Out out;
    AltitudeControl::In in{.estimate = level(), .directive = {.state = FlightState::flying, .altitude = 1}};
    in.estimate.altitude = 1;
    AltitudeControl::run({}, tick, in, state, out);
    CHECK(out.lift.thrust == doctest::Approx(1));
    in.estimate.lift = 0.9 * 9.81;
    for (int i = 0; i < 10; ++i) AltitudeControl::run({}, tick, in, state, out);
    CHECK(out.lift.thrust > 1.1);
  }

  TEST_CASE("hover is signal 8000 to each motor, more for a battery that sags, nothing when halted") {
    MotorMixer::Param at_rest{.quick_lag = 0.05};
    MotorMixer::State state;
    MotorMixer::Out out;
    MotorMixer::In in{.lift = {1}, .directive = {.state = FlightState::flying}, .estimate = {.battery = 15.887}};
    MotorMixer::run(at_rest, tick, in, state, out);
    for (const double signal : out.motors.signals) CHECK(signal == doctest::Approx(8000));
    in.estimate.battery = 14.5;
    MotorMixer::run(at_rest, tick, in, state, out);
    CHECK(out.motors.signals[0] == doctest::Approx(8000 * 15.887 / 14.5));
    in.directive.state = FlightState::halt;
    MotorMixer::run(at_rest, tick, in, state, out);
    CHECK(out.motors.signals == std::array<double, 4>{});
    CHECK_FALSE(out.motors.unlocked);
  }

  TEST_CASE(
      "rolling right takes from the right rotor, noses up give to the front, yaw to the right to right and left") {
    const MotorMixer::State hovering{.reached = {8000, 8000, 8000, 8000}};
    MotorMixer::State state = hovering;
    MotorMixer::Out out;
    MotorMixer::In in{.turn = {0.1, 0, 0}, .lift = {1}, .directive = {.state = FlightState::flying}};
    const auto& s = out.motors.signals;
    MotorMixer::run({}, tick, in, state, out);
    CHECK(s[1] < s[0]);
    CHECK(s[3] > s[0]);
    CHECK(s[0] == s[2]);
    in.turn = {0, 0.1, 0};
    state = hovering;
    MotorMixer::run({}, tick, in, state, out);
    CHECK(s[0] > s[2]);
    CHECK(s[1] == s[3]);
    in.turn = {0, 0, 0.1};
    state = hovering;
    MotorMixer::run({}, tick, in, state, out);
    CHECK(s[1] == s[3]);
    CHECK(s[1] > s[0]);
  }

  TEST_CASE("the trim that holds a place is learnt up to 1 m/s^2, to either side") {
    for (const double side : {-1.0, 1.0}) {
      PositionControl::State state;
      PositionControl::Out out;
      PositionControl::In in{.estimate = level(), .directive = {.state = FlightState::flying, .hold_position = true}};
      PositionControl::run({}, tick, in, state, out);
      in.estimate.x = -0.1 * side;                                                    // pushed away, and held there
      for (int i = 0; i < 2000; ++i) PositionControl::run({}, tick, in, state, out);  // 0.3 * 0.1 * 30 s = 0.9
      CHECK(state.trim_x == doctest::Approx(0.9 * side).scale(0).epsilon(0.01));
      for (int i = 0; i < 2000; ++i) PositionControl::run({}, tick, in, state, out);
      CHECK(state.trim_x == side);
    }
  }
}
