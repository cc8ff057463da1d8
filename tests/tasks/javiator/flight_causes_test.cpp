// What makes the helicopter land by itself, and what it reports as the cause.
#include "tests/tasks/javiator/driven_logic.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;
using jarol::tests::Logic;
}  // namespace

TEST_SUITE("tasks/flight_causes") {
  TEST_CASE("each reason to land is reported, and wins over what the operator wants") {
    const auto cause_of = [](auto change) {
      Logic logic;
      logic.fly();
      change(logic.in);
      CHECK(logic.run(1) == FlightState::landing);
      logic.in.command.altitude = 2;
      logic.run(1);
      CHECK(logic.out.directive.altitude == 0);
      return logic.out.directive.cause;
    };
    using In = FlightLogic::In;
    CHECK(cause_of([](In& in) { in.estimate.roll = -0.61; }) == LandingCause::roll);
    CHECK(cause_of([](In& in) { in.estimate.pitch = 0.61; }) == LandingCause::pitch);
    CHECK(cause_of([](In& in) { in.estimate.yaw = 2.1; }) == LandingCause::yaw);
    CHECK(cause_of([](In& in) { in.estimate.altitude = 2.9; }) == LandingCause::altitude);
    CHECK(cause_of([](In& in) { in.estimate.attitude_known = false; }) == LandingCause::imu_lost);
    CHECK(cause_of([](In& in) { in.estimate.altitude_known = false; }) == LandingCause::sonar_lost);
    CHECK(cause_of([](In& in) { in.estimate.pressure_known = false; }) == LandingCause::bmu_lost);
    CHECK(cause_of([](In& in) { in.estimate.battery = 13.3; }) == LandingCause::battery_low);
  }

  TEST_CASE("a lost place matters only to who holds a place") {
    Logic logic;
    logic.fly();
    logic.in.estimate.position_known = false;
    CHECK(logic.run(10) == FlightState::flying);
    logic.in.command.mode_switches = 1;
    CHECK(logic.run(1) == FlightState::landing);
    CHECK(logic.out.directive.cause == LandingCause::position_lost);
  }

  TEST_CASE("a weak motor is named, not the lean that it makes") {
    Logic logic;
    logic.fly();
    logic.in.motors.weak = Motor::left;
    logic.in.estimate.roll = 0.7;
    CHECK(logic.run(1) == FlightState::landing);
    CHECK(logic.out.directive.cause == LandingCause::motor_weak);
  }

  TEST_CASE("answers that are late are named, not the IMU that was in them") {
    Logic logic;
    logic.fly();
    logic.in.estimate.answers_known = logic.in.estimate.rates_known = false;
    CHECK(logic.run(1) == FlightState::landing);
    CHECK(logic.out.directive.cause == LandingCause::answers_late);
  }

  TEST_CASE("one that does not rise at full thrust for 1.5 s lands, and says so") {
    const auto after = [](int periods, double thrust, double altitude, double climb) {
      Logic logic;
      logic.fly();
      logic.in.lift.thrust = thrust;
      logic.in.estimate.altitude = altitude;
      logic.in.estimate.climb = climb;
      logic.run(periods);
      return logic.out.directive.cause;
    };
    CHECK(after(100, 1.41, 0.89, 0.04) == LandingCause::none);
    CHECK(after(102, 1.41, 0.89, 0.04) == LandingCause::no_lift);
    CHECK(after(1000, 1.39, 0.89, 0.04) == LandingCause::none);
    CHECK(after(1000, 1.41, 0.91, 0.04) == LandingCause::none);
    CHECK(after(1000, 1.41, 0.89, 0.06) == LandingCause::none);
    // gusts that press it down for a second each
    Logic logic;
    logic.fly();
    logic.in.estimate.altitude = 0.5;
    for (int i = 0; i < 10; ++i) {
      logic.in.lift.thrust = 1.5;
      logic.run(67);
      logic.in.lift.thrust = 1;
      CHECK(logic.run(1) == FlightState::flying);
    }
  }

  TEST_CASE("what fails in a landing is reported, once, but that nobody is heard") {
    Logic logic;
    logic.fly();
    logic.press();
    logic.in.command.heard = false;
    logic.run(50);
    CHECK(logic.out.directive.cause == LandingCause::none);
    logic.in.estimate.altitude_known = false;
    CHECK(logic.run(1) == FlightState::landing);
    CHECK(logic.out.directive.cause == LandingCause::sonar_lost);
    logic.in.estimate.attitude_known = false;
    logic.run(1);
    CHECK(logic.out.directive.cause == LandingCause::sonar_lost);
    // one that lands as it has lost its operator has a worse cause then
    Logic alone;
    alone.fly();
    alone.in.command.heard = false;
    alone.run(40);
    CHECK(alone.out.directive.cause == LandingCause::operator_lost);
    alone.in.motors.weak = Motor::front;
    alone.run(1);
    CHECK(alone.out.directive.cause == LandingCause::motor_weak);
  }

  TEST_CASE("each limit makes it land when it is exceeded, to either side, and not before") {
    struct Case {
      double FlightEstimate::*value;
      double inside, outside;
      LandingCause cause;
    };
    const Case cases[] = {{&FlightEstimate::roll, 0.6, 0.601, LandingCause::roll},
                          {&FlightEstimate::roll, -0.6, -0.601, LandingCause::roll},
                          {&FlightEstimate::pitch, 0.6, 0.601, LandingCause::pitch},
                          {&FlightEstimate::pitch, -0.6, -0.601, LandingCause::pitch},
                          {&FlightEstimate::yaw, 2, 2.001, LandingCause::yaw},
                          {&FlightEstimate::yaw, -2, -2.001, LandingCause::yaw},
                          {&FlightEstimate::altitude, 2.8, 2.801, LandingCause::altitude},
                          {&FlightEstimate::battery, 13.4, 13.399, LandingCause::battery_low},
                          {&FlightEstimate::battery, 13.4, 0, LandingCause::bmu_lost}};
    for (const Case& c : cases) {
      CAPTURE(c.outside);
      Logic logic;
      logic.fly();
      logic.in.estimate.*c.value = c.inside;
      CHECK(logic.run(10) == FlightState::flying);
      logic.in.estimate.*c.value = c.outside;
      CHECK(logic.run(1) == FlightState::landing);
      CHECK(logic.out.directive.cause == c.cause);
    }
  }
}
