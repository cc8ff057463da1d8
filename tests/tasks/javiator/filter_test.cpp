#include <doctest/doctest.h>

#include <cmath>

#include "tests/tasks/heard_helicopter.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using Heard = tests::HeardHelicopter;
}  // namespace

TEST_SUITE("tasks/javiator_filter") {
  TEST_CASE("where it stands is the origin, and its heading zero") {
    Heard heard;
    heard.sensors.yaw = 1;
    const FlightEstimate& e = heard.run(50);
    CHECK(e.x == 0);
    CHECK(e.altitude == 0);
    CHECK(e.yaw == 0);
    CHECK(e.lift == doctest::Approx(9.81));
  }

  TEST_CASE("it finds altitude and place, and rest") {
    Heard heard;
    heard.lift_to(1);
    heard.sensors.laser_x -= 0.2;  // nearer the wall in the north
    const FlightEstimate& e = heard.run(300);
    CHECK(e.altitude == doctest::Approx(1).scale(0).epsilon(1e-3));
    CHECK(e.x == doctest::Approx(0.2).scale(0).epsilon(1e-3));
    CHECK(std::abs(e.climb) < 1e-3);
    CHECK(std::abs(e.v_x) < 1e-3);
  }

  TEST_CASE("an acceleration is felt at once, long before places report") {
    Heard heard;
    heard.lift_to(1);
    heard.sensors.a_z = -10.81;
    const FlightEstimate& e = heard.run(2);
    CHECK(e.a_up == doctest::Approx(1).scale(0).epsilon(0.01));
    CHECK(e.climb == doctest::Approx(0.03).scale(0).epsilon(0.1));
  }

  TEST_CASE("single readings that are far off are not taken, and do no harm") {
    Heard heard;
    heard.lift_to(1);
    for (int i = 0; i < 10; ++i) {
      heard.sensors.sonar = 2.9;
      heard.run(1);
      heard.sensors.sonar = 1.145;
      CHECK(heard.run(5).altitude == doctest::Approx(1).scale(0).epsilon(1e-3));
    }
    CHECK(heard.out.estimate.altitude_known);
  }

  TEST_CASE("a sensor that is silent for 0.3 s is lost for this flight, and forgiven on the ground") {
    Heard heard;
    heard.lift_to(1);
    heard.sensors.new_x = false;
    CHECK(heard.run(19).position_known);
    CHECK_FALSE(heard.run(2).position_known);
    heard.sensors.new_x = true;
    CHECK_FALSE(heard.run(100).position_known);
    heard.directive.state = FlightState::ground;
    CHECK(heard.run(1).position_known);
  }

  TEST_CASE("an IMU that is silent for three periods is lost, and no rates are reported") {
    Heard heard;
    heard.lift_to(1);
    heard.sensors.p = 0.5;
    CHECK(heard.run(1).p == 0.5);
    heard.sensors.new_imu = false;
    CHECK(heard.run(1).rates_known);
    const FlightEstimate& e = heard.run(2);
    CHECK_FALSE(e.rates_known);
    CHECK(e.p == 0);
  }

  TEST_CASE("where the filter itself did not run for long, it goes on from what it hears, and loses nothing by that") {
    const auto after_a_pause = [](std::int64_t left_out, double roll) {
      Heard heard;
      heard.lift_to(1);
      heard.activation += left_out;
      heard.sensors.roll = roll;
      return heard.run(20);
    };
    CHECK_FALSE(after_a_pause(0, 0.5).attitude_known);
    const FlightEstimate paused = after_a_pause(53, 0.5);  // 0.8 s
    CHECK(paused.attitude_known);
    CHECK(paused.roll == doctest::Approx(0.5).scale(0).epsilon(0.01));
    CHECK(paused.altitude_known);
    CHECK(paused.answers_known);
    // in 0.1 s it can't have leant by that
    CHECK_FALSE(after_a_pause(6, 0.15).attitude_known);
  }

  TEST_CASE("answers that do not come are late, and no sensor is lost by that") {
    Heard heard;
    heard.lift_to(1);
    const auto without_answers = [&](int periods) {
      for (int i = 0; i < periods; ++i) {
        heard.run(1);
        --heard.sensors.answers;
      }
      return heard.out.estimate;
    };
    ++heard.sensors.answers;
    heard.run(1);
    --heard.sensors.answers;
    CHECK(without_answers(2).answers_known);
    const FlightEstimate late = without_answers(60);
    CHECK_FALSE(late.answers_known);
    CHECK_FALSE(late.rates_known);
    CHECK(late.attitude_known);
    CHECK(late.altitude_known);
    CHECK(late.position_known);
    CHECK(late.pressure_known);
    ++heard.sensors.answers;
    CHECK(heard.run(2).answers_known);
    CHECK(heard.out.estimate.rates_known);
  }

  TEST_CASE("on the ground angles that the weight denies are not believed") {
    Heard heard;
    heard.run(100);
    CHECK(heard.out.estimate.attitude_known);
    heard.sensors.roll = 0.09;
    CHECK(heard.run(200).attitude_known);
    heard.sensors.roll = 0.11;
    CHECK_FALSE(heard.run(200).attitude_known);
    heard.sensors.a_y = -9.81 * 0.11;  // it does stand that way
    CHECK(heard.run(200).attitude_known);
  }

  TEST_CASE("nor are they while its rotors take up speed and the ground still carries it") {
    Heard heard;
    heard.run(100);
    heard.sensors.roll = 0.2;  // just before the key
    heard.run(3);
    heard.directive.state = FlightState::starting;
    heard.directive.stands = true;
    CHECK(heard.run(5).attitude_known);
    CHECK_FALSE(heard.run(40).attitude_known);
    // in the air the weight is not felt
    Heard flying;
    flying.lift_to(1);
    flying.sensors.a_y = 3;
    CHECK(flying.run(40).attitude_known);
  }

  TEST_CASE("sensors that repeat themselves are stuck") {
    Heard heard;
    heard.lift_to(1);
    heard.param.repeats = heard.param.laser_repeats = 40;
    heard.state.sonar.repeats = heard.state.laser_x.repeats = heard.state.laser_y.repeats = 0;
    heard.state.pressure.repeats = 0;
    CHECK(heard.run(39).altitude_known);
    const FlightEstimate& e = heard.run(30);
    CHECK_FALSE(e.altitude_known);
    CHECK_FALSE(e.position_known);
    CHECK_FALSE(e.pressure_known);
  }

  TEST_CASE("angles that jump against the rates are not believed; the rates go on") {
    Heard heard;
    heard.lift_to(1);
    heard.sensors.roll = 0.3;
    heard.run(4);
    CHECK_FALSE(heard.out.estimate.attitude_known);
    CHECK(heard.out.estimate.rates_known);
    CHECK(std::abs(heard.out.estimate.roll) < 1e-9);
    heard.sensors.p = 0.1;
    CHECK(heard.run(100).roll == doctest::Approx(0.15 + 0.02 * 0.1));  // 1.5 s, and the look-ahead
  }

  TEST_CASE("a sonar that drifts away from the pressure is lost, and the pressure reports the altitude") {
    Heard heard;
    heard.lift_to(1);
    for (int i = 0; i < 400; ++i) {
      heard.sensors.sonar -= 0.8 / 400;
      heard.run(1);
    }
    const FlightEstimate& e = heard.run(600);
    CHECK_FALSE(e.altitude_known);
    CHECK(e.altitude == doctest::Approx(1).scale(0).epsilon(0.02));
  }

  TEST_CASE("after a flight it reports where it stands until the next take-off, which is the new origin") {
    Heard heard;
    heard.lift_to(1);
    heard.sensors.laser_y -= 0.25;
    heard.run(300);
    heard.directive.state = FlightState::ground;
    heard.sensors.sonar = 0.145;
    CHECK(heard.run(200).y == doctest::Approx(0.25).scale(0).epsilon(1e-3));
    CHECK(std::abs(heard.out.estimate.altitude) < 1e-3);
    heard.directive.state = FlightState::starting;
    CHECK(std::abs(heard.run(1).y) < 1e-3);
  }

  TEST_CASE("a reading counts as often as it is tolerated, and no more") {
    for (const int repeats : {1, 2, 5}) {
      CAPTURE(repeats);
      Heard heard;
      heard.param.repeats = static_cast<std::uint32_t>(repeats);
      int step = 0;
      const auto next = [&] { heard.sensors.sonar = 0.145 + 1e-4 * (++step % 2); };
      for (int i = 0; i < 100; ++i) {
        next();
        heard.run(1);
      }
      heard.directive.state = FlightState::flying;
      for (int i = 0; i < 100; ++i) {
        next();
        heard.run(repeats);
        CHECK(heard.state.sonar.silent == 0);
      }
      heard.run(1);
      CHECK(heard.state.sonar.silent == doctest::Approx(0.015));
      CHECK_FALSE(heard.state.sonar.lost);
    }
  }

  TEST_CASE(
      "heard again after more than 0.3 s its altitude is known as soon as two ranges agree, which begin it anew") {
    tests::HeardHelicopter heard = tests::hovering();
    heard.state.z.speed = 1;  // it rises as nothing more is heard
    const double before = heard.out.estimate.altitude;
    const auto be_silent = [&](int periods) {
      for (int i = 0; i < periods; ++i) {
        --heard.sensors.answers;
        heard.run(1);
      }
    };
    be_silent(200);
    CHECK(heard.out.estimate.altitude > before + 0.5);  // it does not know better
    heard.sensors.new_sonar = false;
    heard.sensors.pressure = 101325;
    CHECK_FALSE(heard.run(2).answers_known);
    heard.sensors.new_sonar = true;
    heard.sensors.sonar = 0.9;  // one alone may be wrong
    CHECK_FALSE(heard.run(1).answers_known);
    heard.sensors.sonar = 0.145;
    CHECK_FALSE(heard.run(1).answers_known);
    const FlightEstimate& e = heard.run(1);
    CHECK(e.answers_known);
    CHECK(e.altitude_known);
    CHECK(std::abs(e.altitude) < 0.01);
    CHECK(std::abs(e.climb) < 0.01);
    heard.run(100);
    CHECK(e.altitude_known);
    CHECK(e.pressure_known);
    CHECK(std::abs(e.altitude) < 0.01);
  }
}
