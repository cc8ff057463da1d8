// How the helicopter's filter finds out which sensor drifts: each limit and time, at its edge.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>

#include "tests/tasks/heard_helicopter.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using jarol::tests::HeardHelicopter;
using jarol::tests::hovering;

}  // namespace

TEST_SUITE("tasks/javiator_filter/drift") {
  TEST_CASE("where sonar and pressure disagree, the sonar is lost if its climb was 25 mm/s off, else the pressure") {
    for (const double off : {0.0255, 0.0259}) {
      HeardHelicopter heard = hovering();
      heard.state.z_slow = heard.state.z;
      heard.state.climb_off = 0;
      heard.state.climb_was_off = off;  // of which 0.15 % are forgotten each period
      heard.sensors.pressure -= 12;
      heard.run(18);
      CHECK(heard.out.estimate.altitude_known == (off < 0.0257));
      CHECK(heard.out.estimate.pressure_known == (off > 0.0257));
    }
  }

  TEST_CASE("a climb that is off is averaged over half a second, whichever way it is off, and forgotten in ten") {
    for (const double side : {-1.0, 1.0}) {
      HeardHelicopter heard = hovering();
      heard.state.z_slow = heard.state.z;
      heard.state.climb_off = heard.state.climb_was_off = 0;
      heard.state.z_slow.speed -= 0.1 * side;
      heard.run(1);
      CHECK(heard.state.climb_off == doctest::Approx(0.2 * side * HeardHelicopter::dt).scale(0).epsilon(0.02));
      CHECK(heard.state.climb_was_off == doctest::Approx(0.2 * HeardHelicopter::dt).scale(0).epsilon(0.02));
      heard.state.climb_was_off = 1;
      heard.run(1);
      CHECK(heard.state.climb_was_off == doctest::Approx(1 - HeardHelicopter::dt / 10).scale(0).epsilon(1e-6));
    }
  }

  TEST_CASE("the observer that hardly trusts the sonar has its poles at 0.8 rad/s") {
    HeardHelicopter heard = hovering();
    heard.state.z_slow = {.place = heard.state.z.place - 0.01};
    const double speed = heard.state.z_slow.speed, pole = std::exp(-0.8 * HeardHelicopter::dt);
    heard.run(1);
    CHECK(heard.state.z_slow.speed - speed ==
          doctest::Approx(1.5 * (1 - pole) * (1 - pole) * (1 + pole) * 0.01 / HeardHelicopter::dt)
              .scale(0)
              .epsilon(0.05));
  }

  TEST_CASE("without its sonar it goes on with the climb and the bias that were hardly the sonar's") {
    HeardHelicopter heard = hovering();
    heard.state.z_slow.speed = 0.05;
    heard.state.z_slow.bias = 0.02;
    heard.sensors.new_sonar = false;
    heard.sensors.new_bmu = false;
    heard.run(19);
    CHECK(heard.state.z.bias != 0.02);
    while (heard.out.estimate.altitude_known) heard.run(1);
    CHECK(heard.state.z.bias == 0.02);
    CHECK(heard.state.z.speed == heard.state.z_slow.speed);
  }

  TEST_CASE(
      "angles that are 15 mrad from where the rates turned it of late, and 20 mrad from what the places report, are "
      "lost, "
      "and it goes on with the rates") {
    for (const bool rolls : {true, false}) {
      for (const double side : {-1.0, 1.0}) {
        const auto drifting = [&](double by_rates, double by_places) {
          HeardHelicopter heard = hovering();
          (rolls ? heard.state.slow_roll : heard.state.slow_pitch).angle = -by_rates * side;
          (rolls ? heard.state.roll_off : heard.state.pitch_off) = by_places * side;
          return heard.run(1);
        };
        CHECK(drifting(0.0148, 1).attitude_known);
        CHECK(drifting(1, 0.0199).attitude_known);
        CHECK(drifting(1, -1).attitude_known);
        const FlightEstimate e = drifting(0.0152, 0.0201);
        CHECK_FALSE(e.attitude_known);
        CHECK((rolls ? e.roll : e.pitch) == doctest::Approx(-0.0152 * side).scale(0).epsilon(0.02));
      }
    }
  }

  TEST_CASE("what the places take for a bias of acceleration is gravity turned by a wrong angle, averaged over 1.5 s") {
    const auto off_at = [](double heading, double north, double east) {
      HeardHelicopter heard = hovering();
      heard.sensors.new_x = heard.sensors.new_y = false;
      heard.sensors.yaw = heard.state.zero_yaw = heading;
      heard.state.roll_off = heard.state.pitch_off = 0;
      heard.state.x.bias = north;
      heard.state.y.bias = east;
      heard.run(1);
      return Eigen::Vector2d(heard.state.roll_off, heard.state.pitch_off);
    };
    const double part = HeardHelicopter::dt / 1.5 * 0.1 / 9.81;
    CHECK((off_at(0, 0, 0.1) - Eigen::Vector2d(part, 0)).norm() < 1e-9);
    CHECK((off_at(0, 0.1, 0) - Eigen::Vector2d(0, -part)).norm() < 1e-9);
    CHECK((off_at(M_PI / 2, 0.1, 0) - Eigen::Vector2d(-part, 0)).norm() < 1e-9);
    CHECK((off_at(M_PI / 2, 0, 0.1) - Eigen::Vector2d(0, -part)).norm() < 1e-9);
  }

  TEST_CASE("errors of the slow angles and of their rates' biases die out with two poles of 0.25 rad/s") {
    const HeardHelicopter before = hovering();
    const auto next = [&](double angle, double bias) {
      HeardHelicopter heard = before;
      heard.state.slow_pitch.angle += angle;
      heard.state.slow_pitch.bias += bias;
      heard.run(1);
      return Eigen::Vector2d(heard.state.slow_pitch.angle, heard.state.slow_pitch.bias);
    };
    Eigen::Matrix2d step;
    step.col(0) = (next(0.01, 0) - next(0, 0)) / 0.01;
    step.col(1) = (next(0, 0.01) - next(0, 0)) / 0.01;
    const double pole = std::exp(-0.25 * HeardHelicopter::dt);
    CHECK(step.trace() == doctest::Approx(2 * pole).epsilon(1e-9));
    CHECK(step.determinant() == doctest::Approx(pole * pole).epsilon(1e-9));
  }

  TEST_CASE("what it turned while the IMU was not heard, by the rates before and after, is no drift of the angles") {
    for (const bool turns : {true, false}) {
      HeardHelicopter heard = hovering();
      heard.sensors.new_imu = false;
      heard.run(1);
      heard.sensors.new_imu = true;
      heard.sensors.roll = 0.03;
      heard.sensors.pitch = -0.03;
      heard.sensors.p = turns ? 2 : 0;
      heard.sensors.q = turns ? -2 : 0;
      heard.run(1);
      heard.sensors.p = heard.sensors.q = 0;
      heard.state.roll_off = 0.03;
      heard.state.pitch_off = -0.03;
      CHECK(heard.run(9).attitude_known == turns);
    }
    HeardHelicopter heard_all = hovering();
    heard_all.sensors.roll = 0.03;
    heard_all.state.roll_off = 0.03;
    CHECK_FALSE(heard_all.run(10).attitude_known);
  }

  TEST_CASE("angles that are suddenly wrong don't turn a vehicle that yaws, neither before nor after they are lost") {
    for (const bool rolls : {true, false}) {
      HeardHelicopter heard = hovering();
      heard.sensors.r = 1;
      (rolls ? heard.sensors.roll : heard.sensors.pitch) = 0.3;
      for (int i = 0; i < 60; ++i) {
        heard.sensors.yaw += HeardHelicopter::dt;
        heard.run(1);
        CHECK(std::abs(heard.state.roll) < 1e-3);
        CHECK(std::abs(heard.state.pitch) < 1e-3);
      }
      CHECK_FALSE(heard.out.estimate.attitude_known);
    }
  }

  TEST_CASE("the rates' biases are learnt while it stands") {
    HeardHelicopter heard;
    heard.run(100);
    heard.sensors.p = 0.01;
    heard.sensors.q = -0.02;
    heard.run(1);
    CHECK(heard.state.slow_roll.bias == doctest::Approx(0.02 * 0.01));
    CHECK(heard.state.slow_pitch.bias == doctest::Approx(-0.02 * 0.02));
  }

  TEST_CASE("where readings were lost an angle is credible up to 0.1 rad from where the rates before and after lead") {
    for (const bool rolls : {true, false}) {
      for (const double off : {-0.101, -0.099, 0.099, 0.101}) {
        CAPTURE(rolls);
        CAPTURE(off);
        HeardHelicopter heard = hovering();
        heard.param.angle_gain = 1;
        double& rate = rolls ? heard.sensors.p : heard.sensors.q;
        rate = 4;
        heard.run(1);
        for (int i = 0; i < 3; ++i) {
          --heard.sensors.answers;
          heard.run(1);
        }
        rate = 2;
        (rolls ? heard.sensors.roll : heard.sensors.pitch) = 4 * HeardHelicopter::dt * (4 + 2) / 2 + off;
        heard.run(1);
        CHECK((heard.state.angles.silent == 0) == (std::abs(off) < 0.1));
      }
    }
  }
}
