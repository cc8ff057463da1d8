#include "tasks/javiator/original_control.h"

#include <doctest/doctest.h>

#include <cmath>

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;

Tick tick_of(std::int64_t activation) { return {.now = activation * 15ms, .activation = activation, .period = 15ms}; }
}  // namespace

TEST_SUITE("tasks/original_control") {
  TEST_CASE("a commanded roll of 5 mrad is smoothed to 1 mrad and makes 35 units, as recorded") {
    OriginalLogic::State logic;
    OriginalLogic::Out directive;
    OriginalLogic::run({}, tick_of(0), {.command = {.roll = 5e-3}}, logic, directive);
    CHECK(directive.directive.roll == doctest::Approx(1e-3));
    OriginalAttitude::State state;
    OriginalAttitude::Out out;
    OriginalAttitude::run({}, tick_of(0), {.goal = {.roll = 1e-3}}, state, out);
    CHECK(std::trunc(8000 * out.turn.roll) == 35);
    OriginalAttitude::run({}, tick_of(1), {.goal = {.roll = 2.8e-3}}, state, out);
    CHECK(std::trunc(8000 * out.turn.roll) == 64);
  }

  TEST_CASE("signals grow by 50 a period to 8000 before flight, and shrink by 50 after it") {
    OriginalLogic::State logic;
    OriginalLogic::Out directive;
    OriginalMixer::Out motors;
    const auto run = [&](std::uint32_t switches) {
      OriginalMixer::run({}, tick_of(0), {.lift = {1}, .directive = directive.directive}, motors);
      OriginalLogic::run({}, tick_of(0), {.command = {.state_switches = switches}}, logic, directive);
    };
    run(1);
    CHECK(directive.directive.state == FlightState::ground);
    CHECK_FALSE(motors.motors.unlocked);
    run(2);
    CHECK(motors.motors.unlocked);
    for (int i = 1; i <= 160; ++i) {
      CHECK(directive.directive.state == FlightState::starting);
      run(2);
      CHECK(motors.motors.signals[0] == 50 * i);
    }
    CHECK(directive.directive.state == FlightState::flying);
    run(3);
    CHECK(motors.motors.signals[2] == 8000);
    for (int i = 1; i <= 161; ++i) {
      run(3);
      CHECK(motors.motors.signals[3] == std::max(8000 - 50 * i, 0));
    }
  }

  TEST_CASE("the key pressed again while rotors run down flies on at once, and later starts from the ground") {
    for (const int periods : {10, 150, 200}) {
      CAPTURE(periods);
      OriginalLogic::State logic;
      OriginalLogic::Out directive;
      OriginalMixer::Out motors;
      const auto run = [&](std::uint32_t switches, int times) {
        for (int i = 0; i < times; ++i) {
          OriginalLogic::run({}, tick_of(0), {.command = {.state_switches = switches}}, logic, directive);
          OriginalMixer::run({}, tick_of(0), {.lift = {1}, .directive = directive.directive}, motors);
        }
        return directive.directive.state;
      };
      run(1, 1);
      run(2, 1);
      CHECK(run(2, 160) == FlightState::flying);
      CHECK(run(3, periods) == FlightState::ground);
      run(4, 1);
      CHECK(run(4, 1) == (periods < 160 ? FlightState::flying : FlightState::starting));
      double max_signal = 0;
      for (int i = 0; i < 200; ++i) {
        run(4, 1);
        max_signal = std::max(max_signal, motors.motors.signals[0]);
      }
      CHECK(max_signal == 8000);
    }
  }

  TEST_CASE(
      "rolling right takes from the right rotor, noses up give to the front, yaw to the right to right and left") {
    OriginalMixer::Out out;
    OriginalMixer::In in{.turn = {0.01, 0, 0}, .lift = {1}, .directive = {.state = FlightState::flying}};
    using Signals = std::array<double, 4>;
    OriginalMixer::run({}, tick_of(0), in, out);
    CHECK(out.motors.signals == Signals{8000, 7920, 8000, 8080});
    in.turn = {0, 0.01, 0};
    OriginalMixer::run({}, tick_of(0), in, out);
    CHECK(out.motors.signals == Signals{8080, 8000, 7920, 8000});
    in.turn = {0, 0, 0.01};
    OriginalMixer::run({}, tick_of(0), in, out);
    CHECK(out.motors.signals == Signals{7920, 8080, 7920, 8080});
  }

  TEST_CASE("it leans at most 300 mrad to reach a place, by hand as much as it is commanded") {
    OriginalPosition::State state;
    OriginalPosition::Out out;
    OriginalPosition::In in{.directive = {.state = FlightState::flying, .hold_position = true, .x = 5, .y = 5}};
    OriginalPosition::run({}, tick_of(0), in, state, out);
    CHECK(out.goal.roll == doctest::Approx(0.3));
    CHECK(out.goal.pitch == doctest::Approx(-0.3));
    in.directive.hold_position = false;
    in.directive.roll = 0.5;
    OriginalPosition::run({}, tick_of(1), in, state, out);
    CHECK(out.goal.roll == doctest::Approx(0.5));
  }

  TEST_CASE("near its place it corrects seldom: at 9 mm every hundredth period") {
    OriginalPosition::State state;
    OriginalPosition::Out out;
    const OriginalPosition::In in{.directive = {.state = FlightState::flying, .hold_position = true, .x = 0.009}};
    for (int i = 0; i < 99; ++i) {
      OriginalPosition::run({}, tick_of(i), in, state, out);
      CHECK(out.goal.pitch == 0);
    }
    OriginalPosition::run({}, tick_of(99), in, state, out);
    CHECK(out.goal.pitch < 0);
  }

  TEST_CASE("it counts periods between corrections in whole numbers: from 0.5 m on it corrects in each") {
    struct Case {
      double error;
      int periods;
    };
    for (const Case& c : {Case{0.6, 1}, Case{0.5, 1}, Case{0.499, 2}, Case{0.334, 2}, Case{0.332, 3}}) {
      CAPTURE(c.error);
      OriginalPosition::State state;
      OriginalPosition::Out out;
      const OriginalPosition::In in{.directive = {.state = FlightState::flying, .hold_position = true, .x = c.error}};
      int run = 0;
      while (out.goal.pitch == 0) OriginalPosition::run({}, tick_of(run), in, state, out), ++run;
      CHECK(run == c.periods);
    }
  }
}
