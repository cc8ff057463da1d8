// The numbers of the helicopter's filter: each gain, limit and time, at its edge.
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

TEST_SUITE("tasks/javiator_filter/edges") {
  TEST_CASE("a laser is credible up to 30 cm from where it should be, and so is a sonar when the IMU is lost") {
    for (const double side : {-1.0, 1.0}) {
      HeardHelicopter near = hovering();
      near.sensors.laser_x += 0.299 * side;
      near.sensors.laser_y += 0.299 * side;
      near.run(1);
      CHECK(near.state.laser_x.silent + near.state.laser_y.silent == 0);
      HeardHelicopter far = hovering();
      far.sensors.laser_x += 0.301 * side;
      far.sensors.laser_y += 0.301 * side;
      far.run(1);
      CHECK(far.state.laser_x.silent + far.state.laser_y.silent == doctest::Approx(2 * HeardHelicopter::dt));
      for (const double part : {0.299, 0.301}) {
        HeardHelicopter blind = hovering();
        blind.state.imu.lost = true;
        blind.sensors.sonar += part * side;
        blind.run(1);
        CHECK((blind.state.sonar.silent == 0) == (part < 0.3));
      }
    }
  }

  TEST_CASE("a sonar is credible up to 8 cm from where it should be, and 10 cm more for each second without one") {
    for (const double side : {-1.0, 1.0}) {
      for (const int silent : {0, 10}) {
        CAPTURE(silent);
        const double max = 0.08 + 0.1 * HeardHelicopter::dt * (silent + 1);
        HeardHelicopter near = hovering();
        near.sensors.new_sonar = false;
        near.run(silent);
        HeardHelicopter far = near;
        near.sensors.new_sonar = far.sensors.new_sonar = true;
        near.sensors.sonar += (max - 1e-3) * side;
        CHECK(std::abs(near.run(1).altitude - 1) > 0.01);
        CHECK(near.state.sonar.silent == 0);
        far.sensors.sonar += (max + 1e-3) * side;
        CHECK(far.run(1).altitude == doctest::Approx(1).scale(0).epsilon(1e-3));
        CHECK(far.state.sonar.silent == doctest::Approx(HeardHelicopter::dt * (silent + 1)));
      }
    }
  }

  TEST_CASE("what a sonar has taught before it was seen to repeat for the sixth time is forgotten") {
    HeardHelicopter heard = hovering();
    heard.param.sonar_repeats = 6;
    heard.state.sonar.repeats = 0;
    heard.state.z_slow.speed = -0.3;
    heard.state.z_slow.bias = 0.02;
    heard.run(5);
    CHECK(std::abs(heard.state.z.speed) < 0.01);
    heard.run(1);
    CHECK(heard.state.z.speed == heard.state.z_slow.speed);
    CHECK(heard.state.z.bias == heard.state.z_slow.bias);
    heard.state.z.speed = 0;
    heard.run(1);
    CHECK(std::abs(heard.state.z.speed) < 0.01);
  }

  TEST_CASE("a laser's reading that repeats is not used, and a sixth time it is no sign of life") {
    HeardHelicopter heard = hovering();
    heard.param.laser_repeats = 5;
    heard.sensors.laser_x -= 0.01;
    heard.run(1);
    CHECK(heard.state.x.since == 0);
    for (int i = 1; i <= 4; ++i) {
      heard.run(1);
      CHECK(heard.state.x.since == doctest::Approx(i * HeardHelicopter::dt));
      CHECK(heard.state.laser_x.silent == 0);
    }
    heard.run(1);
    CHECK(heard.state.laser_x.silent == doctest::Approx(HeardHelicopter::dt));
  }

  TEST_CASE("a sonar's range is used six times, and not again") {
    HeardHelicopter heard = hovering();
    heard.param.sonar_repeats = 6;
    heard.sensors.sonar += 0.01;
    heard.run(6);
    CHECK(heard.state.z.since == 0);
    heard.run(1);
    CHECK(heard.state.z.since == doctest::Approx(HeardHelicopter::dt));
    CHECK(heard.state.sonar.silent == 0);
  }

  TEST_CASE("before the Robostix has answered nothing is felt") {
    HeardHelicopter heard;
    heard.sensors.answers = static_cast<std::uint32_t>(-1);  // none yet when it runs first
    heard.sensors.a_x = heard.sensors.a_y = heard.sensors.a_z = 0;
    heard.run(1);
    CHECK(heard.state.x.bias == 0);
    CHECK(heard.state.y.bias == 0);
    CHECK(heard.state.z.bias == 0);
  }

  TEST_CASE("errors of place, speed and bias die out with three poles of 6 rad/s") {
    const HeardHelicopter before = hovering();
    const auto next = [&](const Eigen::Vector3d& error) {
      HeardHelicopter heard = before;
      heard.state.x.place += error.x();
      heard.state.x.speed += error.y();
      heard.state.x.bias += error.z();
      heard.run(1);
      return Eigen::Vector3d(heard.state.x.place, heard.state.x.speed, heard.state.x.bias);
    };
    // what a step makes of each error alone; (lambda - pole)^3 is its characteristic polynomial
    Eigen::Matrix3d step;
    for (int i = 0; i < 3; ++i) step.col(i) = (next(0.01 * Eigen::Vector3d::Unit(i)) - next({0, 0, 0})) / 0.01;
    const double pole = std::exp(-6 * HeardHelicopter::dt), trace = step.trace();
    CHECK(trace == doctest::Approx(3 * pole));
    CHECK((trace * trace - (step * step).trace()) / 2 == doctest::Approx(3 * pole * pole));
    CHECK(step.determinant() == doctest::Approx(pole * pole * pole));
  }

  TEST_CASE("roll and pitch are believed up to 0.1 rad from where the rates turned them, and half of it is taken") {
    // and drift as they like
    const auto hovering = [] {
      HeardHelicopter heard = ::hovering();
      heard.param.drift.angle = 1;
      return heard;
    };
    for (double JaviatorSensors::*angle : {&JaviatorSensors::roll, &JaviatorSensors::pitch}) {
      for (const double side : {-1.0, 1.0}) {
        HeardHelicopter near = hovering();
        near.sensors.*angle = 0.099 * side;
        near.run(1);
        CHECK(near.state.roll + near.state.pitch == doctest::Approx(0.0495 * side));
        CHECK(near.run(10).attitude_known);
        HeardHelicopter far = hovering();
        far.sensors.*angle = 0.101 * side;
        CHECK(far.run(2).attitude_known);
        CHECK_FALSE(far.run(1).attitude_known);  // 45 ms
        CHECK(far.state.roll == doctest::Approx(0));
        CHECK(far.state.pitch == doctest::Approx(0));
      }
    }
  }

  TEST_CASE("half of a yaw that is measured is taken, however far it is") {
    HeardHelicopter heard = hovering();
    heard.sensors.yaw = 0.4;
    CHECK(heard.run(1).yaw == doctest::Approx(0.2));
  }

  TEST_CASE("each sensor has 0.3 s of patience, the IMU 40 ms") {
    struct Case {
      bool JaviatorSensors::*is_new;
      bool FlightEstimate::*known;
      int periods;
    };
    const Case cases[] = {{&JaviatorSensors::new_x, &FlightEstimate::position_known, 20},
                          {&JaviatorSensors::new_y, &FlightEstimate::position_known, 20},
                          {&JaviatorSensors::new_sonar, &FlightEstimate::altitude_known, 20},
                          {&JaviatorSensors::new_bmu, &FlightEstimate::pressure_known, 20},
                          {&JaviatorSensors::new_imu, &FlightEstimate::rates_known, 2}};
    for (const Case& c : cases) {
      HeardHelicopter heard = hovering();
      heard.sensors.*c.is_new = false;
      // the sum of twenty periods may lie a rounding above 0.3
      CHECK(heard.run(c.periods - 1).*c.known);
      CHECK_FALSE(heard.run(2).*c.known);
    }
  }

  TEST_CASE("towards corners the place is known for 1.5 s, and again if it is seen within 3 s") {
    constexpr double eighth = 0.7853981633974483;
    const auto turned_for = [](int periods, double off = 0) {
      HeardHelicopter heard = hovering();
      heard.param.room = {8, 8, 8, 8};
      const double x = heard.sensors.laser_x, y = heard.sensors.laser_y, zero = heard.state.zero_yaw;
      heard.state.zero_yaw = heard.sensors.yaw = eighth;
      heard.sensors.laser_x = heard.sensors.laser_y = 11.3;
      heard.run(99);
      CHECK(heard.out.estimate.position_known);
      CHECK_FALSE(heard.run(2).position_known);
      heard.run(periods - 101);
      heard.state.zero_yaw = heard.sensors.yaw = zero;
      heard.sensors.laser_x = x + off;
      heard.sensors.laser_y = y;
      return heard.run(5);
    };
    CHECK(turned_for(198).position_known);
    CHECK_FALSE(turned_for(202).position_known);
    // meanwhile it may have gone astray by half a metre a second, and 30 cm
    CHECK(turned_for(180, 1.4).position_known);
    CHECK_FALSE(turned_for(180, 1.6).position_known);
  }

  TEST_CASE("an IMU that repeats all its readings a fourth time is stuck, another sensor that does so a fortieth") {
    HeardHelicopter heard = hovering();
    heard.param.imu_repeats = 3;
    heard.param.repeats = 40;
    heard.sensors.p = 1e-6;
    CHECK(heard.run(3).rates_known);
    CHECK(heard.state.imu.silent == 0);
    heard.run(1);
    CHECK(heard.state.imu.silent == doctest::Approx(HeardHelicopter::dt));
  }

  TEST_CASE("attitude is turned on by the rates for 20 ms") {
    HeardHelicopter heard = hovering();
    heard.param.angle_gain = 0;
    heard.sensors.p = 0.5;
    heard.sensors.q = -0.25;
    heard.sensors.r = 0.125;
    const FlightEstimate& e = heard.run(1);
    CHECK(e.roll == doctest::Approx(0.5 * (HeardHelicopter::dt + 0.02)));
    CHECK(e.pitch == doctest::Approx(-0.25 * (HeardHelicopter::dt + 0.02)));
    CHECK(e.yaw == doctest::Approx(0.125 * (HeardHelicopter::dt + 0.02)));
  }

  TEST_CASE(
      "between two readings of the IMU it turns on at the last rates, and feels the last forces; both fade in 50 ms") {
    for (const bool answered : {true, false}) {
      CAPTURE(answered);
      HeardHelicopter heard = hovering();
      heard.param.angle_gain = 0;
      heard.sensors.p = 0.5;
      heard.sensors.q = -0.25;
      heard.sensors.r = 0.125;
      heard.sensors.a_x = 2;
      heard.sensors.a_z = -8;
      const FlightEstimate before = heard.run(1);
      CHECK(before.lift == 8);
      if (answered) {
        heard.sensors.new_imu = false;
      } else {
        --heard.sensors.answers;  // none since
      }
      const double left = std::exp(-HeardHelicopter::dt / 0.05);
      const FlightEstimate& e = heard.run(1);
      CHECK(e.p == doctest::Approx(0.5 * left));
      CHECK(e.q == doctest::Approx(-0.25 * left));
      CHECK(e.r == doctest::Approx(0.125 * left));
      CHECK(e.roll - before.roll == doctest::Approx(0.5 * (left * (HeardHelicopter::dt + 0.02) - 0.02)));
      CHECK(e.lift == doctest::Approx(8 * left + 9.81 * (1 - left)).scale(0).epsilon(1e-2));
      CHECK(e.v_x - before.v_x > 0.9 * 2 * left * HeardHelicopter::dt);
      if (answered) heard.run(2);
      CHECK((answered ? e.p : 0.0) == 0);  // it is lost, and nothing of it is believed
    }
  }

  TEST_CASE("the battery is averaged over a second") {
    HeardHelicopter heard = hovering();
    heard.sensors.battery = 14;
    CHECK(heard.run(1).battery == doctest::Approx(15 - HeardHelicopter::dt));
  }

  TEST_CASE("before the Robostix has answered there is no weight to compare with: its angles are not doubted") {
    HeardHelicopter heard;
    heard.sensors = {};
    for (int i = 0; i < 5; ++i)
      JaviatorFilter::run(heard.param, {.period = std::chrono::milliseconds(15)}, {heard.sensors, heard.directive},
                          heard.state, heard.out);
    CHECK(heard.state.slant_roll == 0);
    CHECK(heard.out.estimate.attitude_known);
  }
}
