// When the helicopter starts, flies and turns back: by its operator, or as nobody is heard.
#include "tests/tasks/javiator/driven_logic.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;
using jarol::tests::Logic;
}  // namespace

TEST_SUITE("tasks/flight_logic") {
  TEST_CASE("the operator's key unlocks, starts, and lands; starting takes 1.5 s") {
    Logic logic;
    CHECK(logic.run(1) == FlightState::halt);
    CHECK(logic.press() == FlightState::ground);
    CHECK(logic.press() == FlightState::starting);
    CHECK(logic.run(98) == FlightState::starting);
    CHECK(logic.run(3) == FlightState::flying);
    CHECK(logic.press() == FlightState::landing);
    CHECK(logic.out.directive.cause == LandingCause::none);
  }

  TEST_CASE("it lands where it can stop, with the heading that it has") {
    Logic logic;
    logic.fly();
    logic.in.estimate.x = 3;
    logic.in.estimate.v_x = 2;
    logic.in.estimate.yaw = 0.4;
    logic.press();
    CHECK(logic.out.directive.x == 4);
    CHECK(logic.out.directive.yaw == 0.4);
    CHECK(logic.out.directive.altitude == 0);
  }

  TEST_CASE("a place is commanded no nearer to a wall that it has seen than 1.5 m, counted from where it takes off") {
    Logic logic;
    logic.in.command.mode_switches = 1;
    logic.fly();
    logic.in.command.x = 30;
    logic.in.command.y = -30;
    logic.run(1);
    CHECK(logic.out.directive.x == 30);
    logic.in.estimate.fixes[0] = {.place = 2, .range = 6, .is_new = true};
    logic.in.estimate.fixes[1] = {.place = -1, .range = -4, .is_new = true};
    logic.run(1);
    CHECK(logic.out.directive.x == 6.5);
    CHECK(logic.out.directive.y == -3.5);
    // it may always go back to where it took off
    logic.in.estimate.fixes[1] = {.place = 0, .range = -0.7, .is_new = true};
    logic.run(1);
    CHECK(logic.out.directive.y == 0);
    logic.in.estimate.fixes[0].is_new = logic.in.estimate.fixes[1].is_new = false;
    logic.run(1);
    CHECK(logic.out.directive.x == 6.5);
    logic.press();
    logic.in.estimate.altitude = 0;
    logic.in.lift.thrust = 0;
    CHECK(logic.run(100) == FlightState::ground);
    logic.in.lift.thrust = 1;
    logic.press();
    CHECK(logic.run(102) == FlightState::flying);
    CHECK(logic.out.directive.x == 30);
  }

  TEST_CASE("sent to the ground it stays where it is from 30 cm on, and rises to 30 cm for the way to another place") {
    Logic logic;
    logic.in.command.mode_switches = 1;
    logic.fly();
    logic.in.command.altitude = 0;
    logic.in.estimate.altitude = 0.31;
    logic.in.command.x = 3;
    logic.in.estimate.x = 0.2;
    logic.in.estimate.v_x = 1.01;
    logic.run(1);
    CHECK(logic.out.directive.x == 3);
    CHECK(logic.out.directive.altitude == 0.3);
    logic.in.estimate.v_x = 0.99;
    logic.run(1);
    CHECK(logic.out.directive.altitude == 0);
    logic.in.estimate.altitude = 0.29;
    logic.in.estimate.v_x = 0.2;
    logic.run(1);
    CHECK(logic.out.directive.x == doctest::Approx(0.3));
    CHECK(logic.out.directive.altitude == 0);
    logic.in.estimate.x = 0.25;
    logic.run(1);
    CHECK(logic.out.directive.x == doctest::Approx(0.3));
    logic.in.command.altitude = 0.1;
    logic.run(1);
    CHECK(logic.out.directive.x == 3);
    CHECK(logic.out.directive.altitude == 0.3);
    logic.in.estimate.x = 2.9;
    logic.run(1);
    CHECK(logic.out.directive.altitude == 0.1);
    // what stands is not lifted
    logic.in.estimate.x = 0;
    logic.in.lift.stands = true;
    logic.run(2);
    CHECK(logic.out.directive.altitude == 0.1);
    logic.in.command.altitude = -1;
    logic.in.estimate.altitude = 1;
    logic.run(1);
    CHECK(logic.out.directive.altitude == 0);
  }

  TEST_CASE("landing from a turn, or without a place, it turns along the nearest walls that its lasers can see") {
    Logic logic;
    logic.in.command.mode_switches = 1;
    logic.fly();
    const auto yaw_after = [&](double yaw, double r, bool sees = true, Motor weak = Motor::none) {
      Logic l = logic;
      l.in.estimate.yaw = yaw;
      l.in.estimate.heading = yaw + 0.2;
      l.in.estimate.r = r;
      l.in.estimate.position_known = sees;
      l.in.motors.weak = weak;
      if (sees && weak == Motor::none) ++l.in.command.state_switches;
      CHECK(l.run(1) == FlightState::landing);
      return l.out.directive.yaw;
    };
    constexpr double quarter = 1.5707963267948966;
    CHECK(yaw_after(0.7, 0.29) == 0.7);
    CHECK(yaw_after(0.4, 0.31) == doctest::Approx(-0.2));
    CHECK(yaw_after(0.4, 1) == doctest::Approx(quarter - 0.2));  // it turns on for 0.3 s
    CHECK(yaw_after(-0.4, -1.2) == doctest::Approx(-0.2));
    CHECK(yaw_after(-0.8, -1.2) == doctest::Approx(-quarter - 0.2));
    CHECK(yaw_after(0.7, 0, false) == doctest::Approx(quarter - 0.2));
    CHECK(yaw_after(0.7, 0.5, true, Motor::front) == 0.7);
    logic.in.estimate.altitude = 0.29;  // no time to turn
    CHECK(yaw_after(0.4, 1) == 0.4);
    logic.in.estimate.altitude = 1;
    logic.in.command.mode_switches = 2;
    logic.run(1);
    CHECK(yaw_after(0.4, 1) == 0.4);
  }

  TEST_CASE("that it stands is handed on") {
    Logic logic;
    logic.fly();
    CHECK_FALSE(logic.out.directive.stands);
    logic.in.lift.stands = true;
    logic.run(1);
    CHECK(logic.out.directive.stands);
  }

  TEST_CASE("a silent operator is waited for 525 ms") {
    Logic logic;
    logic.fly();
    logic.in.command.heard = false;
    CHECK(logic.run(34) == FlightState::flying);
    CHECK(logic.run(2) == FlightState::landing);
    CHECK(logic.out.directive.cause == LandingCause::operator_lost);
  }

  TEST_CASE("a shut-down halts at once; a failure while starting goes back to the ground") {
    Logic logic;
    logic.fly();
    logic.in.command.shut_downs = 1;
    CHECK(logic.run(1) == FlightState::halt);

    Logic starting;
    starting.press();
    starting.press();
    starting.in.estimate.altitude_known = false;
    CHECK(starting.run(1) == FlightState::ground);
    CHECK(starting.out.directive.cause == LandingCause::sonar_lost);
  }

  TEST_CASE("turned round it has the heading that it had, and goes on") {
    Logic logic;
    logic.fly();
    for (const double turns : {1.0, -1.0, 5.0}) {
      logic.in.estimate.yaw = 1.9 + turns * 6.283185307179586;
      CHECK(logic.run(10) == FlightState::flying);
    }
    logic.in.estimate.yaw += 0.2;
    CHECK(logic.run(1) == FlightState::landing);
  }

  TEST_CASE(
      "without answers for 2.5 s, or without looking for so long, it halts, and only the operator starts it again") {
    for (const bool looks : {true, false}) {
      Logic logic;
      logic.fly();
      logic.in.estimate.answers_known = !looks;
      if (looks) {
        CHECK(logic.run(166) == FlightState::landing);
      } else {
        logic.activation += 166;
      }
      CHECK(logic.run(1) == FlightState::halt);
      CHECK(logic.out.directive.cause == LandingCause::answers_late);
      logic.in.estimate.answers_known = true;
      CHECK(logic.run(200) == FlightState::halt);
      CHECK(logic.press() == FlightState::ground);
    }
  }

  TEST_CASE(
      "one that was not run for 2.5 s as it started does not take off, and a key pressed meanwhile starts nothing") {
    Logic starting;
    starting.press();
    CHECK(starting.press() == FlightState::starting);
    starting.activation += 170;
    CHECK(starting.run(1) == FlightState::halt);
    Logic standing;
    CHECK(standing.press() == FlightState::ground);
    standing.activation += 170;
    CHECK(standing.press() == FlightState::ground);
    CHECK(standing.run(200) == FlightState::ground);
  }

  TEST_CASE("after a landing that nobody wanted the operator's key only acknowledges: it may have been meant to land") {
    Logic logic;
    logic.fly();
    logic.in.estimate.altitude = 0.01;
    logic.in.estimate.attitude_known = false;
    CHECK(logic.run(200) == FlightState::ground);
    CHECK(logic.out.directive.cause == LandingCause::imu_lost);
    CHECK(logic.press() == FlightState::ground);
    CHECK(logic.out.directive.cause == LandingCause::none);
    logic.in.estimate.attitude_known = true;
    CHECK(logic.press() == FlightState::starting);
  }
}
