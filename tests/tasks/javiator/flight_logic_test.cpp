// When the helicopter starts, flies and lands. In one file: all cases drive one logic through its states.
#include "tasks/javiator/flight_logic.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;

struct Logic {
  FlightLogic::State state{};
  FlightLogic::Out out{};
  FlightLogic::In in{.estimate = {.battery = 15,
                                  .rates_known = true,
                                  .attitude_known = true,
                                  .altitude_known = true,
                                  .position_known = true,
                                  .pressure_known = true,
                                  .answers_known = true},
                     .lift = {1}};

  FlightLogic::Param param{.yaw_limit = 2};
  std::int64_t activation = 0;

  FlightState run(int periods) {
    for (int i = 0; i < periods; ++i)
      FlightLogic::run(param, {.activation = activation++, .period = 15ms}, in, state, out);
    return out.directive.state;
  }
  FlightState press() {
    ++in.command.state_switches;
    return run(1);
  }
  void fly() {
    press();
    press();
    run(101);
    in.estimate.altitude = 1;
    in.command.altitude = 1;
    CHECK(run(1) == FlightState::flying);
  }
};
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
    logic.in.estimate.fix_x = {.place = 2, .range = 6, .is_new = true};
    logic.in.estimate.fix_y = {.place = -1, .range = -4, .is_new = true};
    logic.run(1);
    CHECK(logic.out.directive.x == 6.5);
    CHECK(logic.out.directive.y == -3.5);
    // it may always go back to where it took off
    logic.in.estimate.fix_y = {.place = 0, .range = -0.7, .is_new = true};
    logic.run(1);
    CHECK(logic.out.directive.y == 0);
    logic.in.estimate.fix_x.is_new = logic.in.estimate.fix_y.is_new = false;
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
