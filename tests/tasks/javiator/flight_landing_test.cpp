// When a landing has ended: on the ground, on its side, or in doubt.
#include "tests/tasks/javiator/driven_logic.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;
using jarol::tests::Logic;
}  // namespace

TEST_SUITE("tasks/flight_landing") {
  TEST_CASE("landing ends on the ground: low and still, or lighter than the rotors could carry") {
    Logic logic;
    logic.fly();
    logic.press();
    CHECK(logic.run(100) == FlightState::landing);  // still, but not low
    logic.in.estimate.altitude = 0.01;
    logic.in.lift.thrust = 0.7;
    CHECK(logic.run(25) == FlightState::ground);

    Logic blind;
    blind.fly();
    blind.press();
    blind.in.estimate.altitude_known = false;
    CHECK(blind.run(100) == FlightState::landing);
    blind.in.lift.thrust = 0.4;
    CHECK(blind.run(25) == FlightState::ground);
  }

  TEST_CASE("while nothing is heard it has not touched the ground, whatever it takes its altitude for") {
    Logic logic;
    logic.fly();
    logic.in.estimate.altitude = 0.4;
    logic.in.estimate.answers_known = logic.in.estimate.rates_known = false;
    CHECK(logic.run(160) == FlightState::landing);
    logic.in.estimate.answers_known = logic.in.estimate.rates_known = true;
    CHECK(logic.run(10) == FlightState::landing);
  }

  TEST_CASE("heard again after more than 0.3 s it lands on, or halts where it is below 20 cm by then") {
    for (const double altitude : {0.19, 0.21}) {
      Logic logic;
      logic.fly();
      logic.in.estimate.answers_known = false;
      logic.in.estimate.climb = 1;  // as it was felt last
      CHECK(logic.run(30) == FlightState::landing);
      logic.in.estimate.answers_known = true;
      logic.in.estimate.altitude = altitude;
      CHECK(logic.run(1) == (altitude < 0.2 ? FlightState::halt : FlightState::landing));
      logic.in.estimate.altitude = 0.1;
      CHECK(logic.run(1) == (altitude < 0.2 ? FlightState::halt : FlightState::landing));
    }
  }

  TEST_CASE("one that tips over as it lands, or while it stands, does not report a good landing, and does not start") {
    Logic logic;
    logic.fly();
    logic.press();
    logic.in.estimate.altitude = 0.1;
    logic.in.estimate.roll = -1.5;
    CHECK(logic.run(100) == FlightState::halt);
    CHECK(logic.out.directive.cause == LandingCause::roll);
    // it says so again, and the key never gets further
    CHECK(logic.press() == FlightState::ground);
    CHECK(logic.press() == FlightState::ground);
    CHECK(logic.out.directive.cause == LandingCause::roll);
    logic.in.estimate.roll = 0;
    CHECK(logic.press() == FlightState::ground);
    CHECK(logic.out.directive.cause == LandingCause::none);
    logic.in.estimate.pitch = 0.61;
    logic.run(1);
    CHECK(logic.out.directive.cause == LandingCause::pitch);
    // what it can't know it does not say
    logic.in.estimate.attitude_known = false;
    CHECK(logic.press() == FlightState::ground);
    CHECK(logic.out.directive.cause == LandingCause::none);
  }

  TEST_CASE("a landing that has leant over for 0.1 s, or by its lasers for 0.3 s, ends with the motors locked") {
    const auto after = [](double roll, double pitch, int periods, bool by_imu = true, bool by_lasers = false) {
      Logic logic;
      logic.fly();
      logic.press();
      logic.in.estimate.roll = roll;
      logic.in.estimate.pitch = pitch;
      logic.in.estimate.rates_known = logic.in.estimate.attitude_known = by_imu;
      logic.in.estimate.lean_known = by_lasers;
      return logic.run(periods);
    };
    constexpr double turn = 6.283185307179586;
    CHECK(after(0.79, 0, 100) == FlightState::landing);
    CHECK(after(0.81, 0, 5) == FlightState::landing);
    CHECK(after(0.81, 0, 8) == FlightState::halt);
    CHECK(after(0, -0.81, 8) == FlightState::halt);
    CHECK(after(0.6, 0.6, 8) == FlightState::halt);  // 47 degrees from upright
    CHECK(after(turn + 0.7, 0, 100) == FlightState::landing);
    CHECK(after(turn + 3, 0, 8) == FlightState::halt);
    CHECK(after(0.99, 0, 100, false, true) == FlightState::landing);
    CHECK(after(3, 0, 19, false, true) == FlightState::landing);
    CHECK(after(3, 0, 22, false, true) == FlightState::halt);
    CHECK(after(3, 0, 100, false, false) == FlightState::landing);
    // what was measured last, while no answers come
    Logic unanswered;
    unanswered.fly();
    unanswered.press();
    unanswered.in.estimate.roll = 3;
    unanswered.in.estimate.rates_known = unanswered.in.estimate.answers_known = false;
    CHECK(unanswered.run(100) == FlightState::landing);
  }

  TEST_CASE("one that leans beyond its limits below 20 cm tips over its feet: its motors are locked") {
    const auto at = [](double altitude, double pitch, bool is_known = true) {
      Logic logic;
      logic.fly();
      logic.in.estimate.altitude = altitude;
      logic.in.estimate.pitch = pitch;
      logic.in.estimate.altitude_known = is_known;
      logic.run(1);
      return logic.out.directive;
    };
    CHECK(at(0.19, -0.59).state == FlightState::flying);
    CHECK(at(0.19, -0.61).state == FlightState::halt);
    CHECK(at(0.19, -0.61).cause == LandingCause::pitch);
    CHECK(at(0.21, -0.61).state == FlightState::landing);
    CHECK(at(0.19, -0.61, false).state == FlightState::landing);
    Logic unanswered;
    unanswered.fly();
    unanswered.in.estimate.altitude = 0.19;
    unanswered.in.estimate.pitch = -0.61;
    unanswered.in.estimate.rates_known = unanswered.in.estimate.answers_known = false;
    CHECK(unanswered.run(1) == FlightState::landing);
  }

  TEST_CASE("it has landed after a second, below half a metre and 8 cm/s, or with less than 0.6 of its weight") {
    struct Case {
      double altitude, climb, thrust;
      bool landed;
    };
    for (const Case& c : {Case{0.499, 0, 0.79, true}, Case{0.501, 0, 0.79, false}, Case{0.4, 0.079, 0.79, true},
                          Case{0.4, 0.081, 0.79, false}, Case{0.4, -0.079, 0.79, true}, Case{0.4, -0.081, 0.79, false},
                          Case{0.4, -1, 0.599, true}, Case{0.4, -1, 0.601, false}}) {
      CAPTURE(c.altitude);
      CAPTURE(c.climb);
      CAPTURE(c.thrust);
      Logic logic;
      logic.fly();
      logic.press();
      logic.in.estimate.altitude = c.altitude;
      logic.in.estimate.climb = c.climb;
      logic.in.lift.thrust = c.thrust;
      CHECK(logic.run(65) == FlightState::landing);  // 0.99 s
      CHECK((logic.run(2) == FlightState::ground) == c.landed);
      CHECK((logic.run(1000) == FlightState::ground) == c.landed);
    }
  }

  TEST_CASE(
      "at half a metre and more it has landed after 5 s with little thrust: a motor may carry it that gives too much") {
    Logic logic;
    logic.fly();
    logic.press();
    logic.in.estimate.altitude = 0.5;
    logic.in.lift.thrust = 0.3;
    CHECK(logic.run(330) == FlightState::landing);  // 4.95 s
    CHECK(logic.run(5) == FlightState::ground);
    // an altitude that nobody knows stops nothing
    Logic other;
    other.fly();
    other.press();
    other.in.estimate.altitude_known = false;
    other.in.lift.thrust = 0.3;
    CHECK(other.run(68) == FlightState::ground);
  }

  TEST_CASE("it has landed when it is still for 0.3 s on end") {
    Logic logic;
    logic.fly();
    logic.press();
    logic.run(100);
    logic.in.estimate.altitude = 0.1;
    logic.in.lift.thrust = 0.7;
    CHECK(logic.run(19) == FlightState::landing);
    logic.in.estimate.climb = -0.1;
    CHECK(logic.run(1) == FlightState::landing);
    logic.in.estimate.climb = 0;
    // the sum of twenty periods may lie a rounding above 0.3
    CHECK(logic.run(19) == FlightState::landing);
    CHECK(logic.run(2) == FlightState::ground);
  }

  TEST_CASE("one that leans by more than 0.07 rad, or has more than 0.8 of its thrust, has landed after 1.5 s") {
    struct Case {
      double roll, pitch, thrust;
      bool rates_known, may_fall;
    };
    for (const Case& c : {Case{0, 0, 0.79, true, false}, Case{0, 0, 0.81, true, true}, Case{0.069, 0, 0.7, true, false},
                          Case{-0.071, 0, 0.7, true, true}, Case{0, 0.071, 0.7, true, true},
                          Case{0.06, -0.06, 0.5, true, true}, Case{0.3, 0, 1, false, false}}) {
      CAPTURE(c.roll);
      CAPTURE(c.pitch);
      CAPTURE(c.thrust);
      Logic logic;
      logic.fly();
      logic.press();
      logic.run(100);
      logic.in.estimate.altitude = 0.03;
      logic.in.estimate.roll = c.roll;
      logic.in.estimate.pitch = c.pitch;
      logic.in.estimate.rates_known = c.rates_known;
      logic.in.lift.thrust = c.thrust;
      CHECK((logic.run(22) == FlightState::ground) != c.may_fall);  // 0.33 s
      CHECK((logic.run(77) == FlightState::ground) != c.may_fall);  // 1.485 s
      CHECK(logic.run(3) == FlightState::ground);
    }
  }
}
