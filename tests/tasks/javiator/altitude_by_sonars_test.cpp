// How high the helicopter takes itself to be, and how fast it climbs, when its IMU is lost.
#include <doctest/doctest.h>

#include <cmath>

#include "tasks/javiator/foot_stand.h"
#include "tests/tasks/javiator/sonars_below.h"

namespace {
using namespace jarol::tasks;
using jarol::tests::BlindAboveGround;
using jarol::tests::dt;
using jarol::tests::g_earth;
using jarol::tests::ranges_of;
using jarol::tests::tick;

FlightEstimate estimate_at(double height, double pitch, bool tilt_known) {
  jarol::tests::HeardHelicopter heard;
  heard.lift_to(height);
  heard.sensors.new_imu = false;
  heard.run(10);
  const BlindMotion blind{.pitch = pitch, .lift = g_earth, .known = true, .tilt_known = tilt_known};
  ++heard.sensors.answers;
  // as high as before
  heard.sensors.sonar = (0.2 + height) / std::cos(pitch) - 0.055;
  const SonarRanges sonars = ranges_of(0, pitch, 0.2 + height);
  JaviatorFilter::run(heard.param, tick, {heard.sensors, heard.directive, blind, sonars}, heard.state, heard.out);
  return heard.out.estimate;
}
}  // namespace

TEST_SUITE("tasks/altitude_by_sonars") {
  TEST_CASE("without an IMU it climbs as sonars show, as what carries it is not felt") {
    const auto climb_after = [](bool tilt_known) {
      BlindAboveGround b;
      b.blind.tilt_known = tilt_known;
      b.heard.sensors.sonar += 0.01;
      b.sonars = ranges_of(0, 0, 1.21, b.sonars.readings);
      return b.blind_for(1).climb;
    };
    AxisObserver axis;
    axis.since = dt;
    track(axis, 0.01, JaviatorFilter::Param{}.unfelt.climb);
    CHECK(climb_after(true) == doctest::Approx(axis.speed).epsilon(0.05).scale(0));
    CHECK(climb_after(false) > 1.5 * climb_after(true));
  }

  TEST_CASE("one that hovers still without an IMU, its sonar reporting the same each time, believes that") {
    for (const bool tilt_known : {false, true}) {
      BlindAboveGround b;
      b.heard.param.sonar_repeats = 6;
      // it takes what carries it for less than that is
      b.blind = {.lift = g_earth - 0.3, .known = true, .tilt_known = tilt_known};
      for (int i = 0; i < 100; ++i) {
        if (i < 70) b.heard.sensors.sonar += 1e-9;
        b.blind_for(1);
        CHECK(std::abs(b.heard.out.estimate.climb) < 0.2);
        CHECK(std::abs(b.heard.out.estimate.altitude - 1) < 0.05);
      }
      CHECK(b.heard.out.estimate.altitude_known);
    }
  }

  TEST_CASE("its altitude is that of the mean of four ranges that show a plane, and not what is reported for them") {
    BlindAboveGround b;
    b.heard.sensors.sonar += 0.07;  // two of four were wrong
    CHECK(std::abs(b.blind_for(20).altitude - 1) < 1e-3);
    CHECK(std::abs(b.heard.out.estimate.climb) < 1e-3);
    // the mean of a plane that leans
    b.blind.pitch = 0.15;
    b.sonars = ranges_of(0, 0.15, 1.1, b.sonars.readings);
    CHECK(b.blind_for(40).altitude == doctest::Approx(0.9).epsilon(0.002).scale(0));
    // without them it is what is reported, as it is where they do not show how it leans
    for (const bool known : {true, false}) {
      BlindAboveGround by_one;
      by_one.blind.tilt_known = false;
      by_one.blind.known = known;
      by_one.heard.sensors.sonar += 0.07;
      CHECK(by_one.blind_for(100).altitude == doctest::Approx(1.07).epsilon(0.01).scale(0));
    }
  }

  TEST_CASE("a range that four show is believed up to 30 cm from where it takes itself to be") {
    BlindAboveGround b;
    b.sonars = ranges_of(0, 0, 1.2 + 0.25, b.sonars.readings);
    CHECK(b.blind_for(20).altitude == doctest::Approx(1.25).epsilon(0.01).scale(0));
    b.sonars = ranges_of(0, 0, 1.2 + 0.25 + 0.35, b.sonars.readings);
    CHECK(b.blind_for(20).altitude < 1.3);
    // and so it is where none came for a while
    BlindAboveGround silent;
    CHECK(std::abs(silent.blind_for(14, false).altitude - 1) < 1e-3);
    silent.heard.sensors.sonar += 0.2;
    silent.blind_for(1, false);
    silent.sonars = ranges_of(0, 0, 1.0, silent.sonars.readings);
    CHECK(silent.blind_for(1).altitude < 0.85);
  }

  TEST_CASE(
      "ranges that show none are passed over for 0.15 s, then it believes what is reported for all of them, once each "
      "time") {
    BlindAboveGround b;
    b.sonars.ranges[2] = 0.3;
    const double reported = b.heard.sensors.sonar += 0.05;
    CHECK(std::abs(b.blind_for(9).altitude - 1) < 1e-3);
    CHECK(b.blind_for(2).altitude > 1.02);
    CHECK(b.blind_for(100).altitude == doctest::Approx(reported - 0.145).epsilon(0.01).scale(0));
    CHECK(b.heard.out.estimate.altitude_known);
    int believed = 0;
    for (int i = 0; i < 100; ++i) {
      b.blind_for(1);
      believed += b.heard.state.z.since == 0;
    }
    CHECK(believed == 9);
    // so it does where no ranges come any more
    BlindAboveGround silent;
    silent.heard.sensors.sonar += 0.05;
    CHECK(std::abs(silent.blind_for(9, false).altitude - 1) < 1e-3);
    CHECK(silent.blind_for(100, false).altitude == doctest::Approx(1.05).epsilon(0.01).scale(0));
  }

  TEST_CASE("ranges that come after activations that were left out are those of now") {
    BlindAboveGround b;
    b.blind_for(20);
    b.sonars = ranges_of(0, 0, 1.05, b.sonars.readings + 1);
    ++b.heard.sensors.answers;
    b.heard.state.before.activation = 0;
    const jarol::Tick late{.activation = 6, .period = std::chrono::milliseconds(15)};
    JaviatorFilter::run(b.heard.param, late, {b.heard.sensors, b.heard.directive, b.blind, b.sonars}, b.heard.state,
                        b.heard.out);
    CHECK(b.heard.state.z.since == 0);
    CHECK(b.heard.out.estimate.altitude < 0.9);
  }

  TEST_CASE("a foot may stand below 1 cm and by how much it leans, as far as sonars show that") {
    for (const double pitch : {0.0, 0.15, -0.15}) {
      const double foot = 0.2 * std::sin(std::abs(pitch));
      CHECK_FALSE(estimate_at(foot + 0.012, pitch, true).touches);
      CHECK(estimate_at(foot + 0.008, pitch, true).touches);
      CHECK_FALSE(estimate_at(foot + 0.008, pitch, false).touches);
    }
    CHECK(may_stand({}, -0.15, 0.1, 0.2 * std::sin(0.15) + 0.0099));
    CHECK_FALSE(may_stand({}, -0.15, 0.1, 0.2 * std::sin(0.15) + 0.0101));
    CHECK(estimate_at(0.5, 0, true).tilt_known);
    CHECK_FALSE(estimate_at(0.5, 0, false).tilt_known);
  }

  TEST_CASE("its climb is tracked without a lasting error where what it feels is wrong by as much as wind pushes it") {
    AxisObserver axis{.place = 1};
    double place = 1, speed = 0;
    for (int i = 0; i < 60; ++i) {
      for (int period = 0; period < 3; ++period) {
        place += speed * dt + 0.5 * 0.4 * dt * dt;
        speed += 0.4 * dt;
        predict(axis, 0, dt);
      }
      track(axis, place, {});
    }
    CHECK(axis.place == doctest::Approx(place).epsilon(1e-3).scale(0));
    CHECK(axis.speed == doctest::Approx(speed).epsilon(0.01).scale(0));
    CHECK(axis.bias == doctest::Approx(-0.4).epsilon(0.01).scale(0));
    // alpha and beta of a tracking index of 0.54, and gamma by them
    AxisObserver one;
    one.since = 0.045;
    track(one, 0.01, {.push = 0.8, .noise = 0.003});
    CHECK(one.place == doctest::Approx(0.006422).epsilon(0.001).scale(0));
    CHECK(one.speed == doctest::Approx(0.07178).epsilon(0.001).scale(0));
    CHECK(one.bias == doctest::Approx(-0.4011).epsilon(0.001).scale(0));
  }
}
