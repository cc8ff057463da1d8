// How the helicopter leans when its IMU is lost, by the ranges of its four sonars.
#include <doctest/doctest.h>

#include <cmath>

#include "tasks/javiator/blind_observer.h"
#include "tasks/javiator/sonar_tilt.h"
#include "tests/tasks/heard_helicopter.h"
#include "tests/tasks/javiator/every_15_ms.h"
#include "tests/tasks/javiator/sonars_below.h"

namespace {
using namespace jarol::tasks;
using jarol::tests::dt;
using jarol::tests::g_earth;
using jarol::tests::ranges_of;
using jarol::tests::tick;

// An observer whose IMU is lost after it was level at 0.3 m, and has been told of the sonars each 45 ms.
struct BySonars {
  BlindObserver::Param param{};
  BlindObserver::State state{};
  BlindObserver::Out out{};
  BlindObserver::In in{.estimate = {.altitude = 0.3,
                                    .lift = g_earth,
                                    .rates_known = true,
                                    .attitude_known = true,
                                    .altitude_known = true},
                       .lift = {1}};

  // Ranges of that lean; none is that before to the last digit, unless they are stuck.
  const BlindMotion& run(double roll, double pitch, int readings, bool stuck = false) {
    for (int i = 0; i < readings; ++i) {
      const std::uint32_t number = in.sonars.readings + 1;
      in.sonars = ranges_of(roll, pitch, stuck ? 0.5 : 0.5 + 1e-9 * number, number);
      for (int period = 0; period < 3; ++period) BlindObserver::run(param, tick, in, state, out);
    }
    return out.motion;
  }
  void lose_imu(double roll = 0, double pitch = 0) {
    run(roll, pitch, 200);
    in.estimate.rates_known = false;
  }
};

}  // namespace

TEST_SUITE("tasks/lean_by_sonars") {
  TEST_CASE("four ranges of level ground show roll and pitch, from any height and however it leans") {
    for (const double height : {0.2, 1.0, 1.9})
      for (const double roll : {-0.5, 0.0, 0.3})
        for (const double pitch : {-0.4, 0.1, 0.5}) {
          const auto tilt = find_tilt({}, ranges_of(roll, pitch, height));
          REQUIRE(tilt);
          CHECK(tilt->roll == doctest::Approx(roll));
          CHECK(tilt->pitch == doctest::Approx(pitch));
        }
  }

  TEST_CASE("ranges that are not those of a plane, by more than 3 cm, or beyond 2.9 m, show nothing") {
    for (std::size_t wrong = 0; wrong < 4; ++wrong)
      for (const double side : {-1.0, 1.0}) {
        SonarRanges sonars = ranges_of(0.1, 0.1, 1);
        sonars.ranges[wrong] += 0.029 * side;
        CHECK(find_tilt({}, sonars));
        sonars.ranges[wrong] += 0.002 * side;
        CHECK_FALSE(find_tilt({}, sonars));
      }
    CHECK(find_tilt({}, ranges_of(0, 0, 2.95)));
    CHECK_FALSE(find_tilt({}, ranges_of(0, 0, 2.96)));
    CHECK_FALSE(find_tilt({}, ranges_of(0, 0.1, 2.93)));  // one of them
  }

  TEST_CASE("without an IMU it leans as the sonars show, whatever its heading, and no laser has to see it") {
    for (const double heading : {0.0, 0.8, -2.0}) {
      BySonars b;
      b.in.estimate.heading = heading;
      b.lose_imu();
      const BlindMotion& m = b.run(0.1, -0.06, 30);
      CHECK(m.roll == doctest::Approx(0.1).epsilon(0.1).scale(0));
      CHECK(m.pitch == doctest::Approx(-0.06).epsilon(0.1).scale(0));
      CHECK(m.known);
      CHECK(m.tilt_known);
    }
  }

  TEST_CASE("sonars that are lost show nothing, nor do those that repeat all four ranges six times") {
    BySonars lost;
    lost.lose_imu();
    lost.in.estimate.altitude_known = false;
    for (int i = 0; i < 10; ++i) lost.run(0.2, 0, 1);
    CHECK(std::abs(lost.out.motion.roll) < 1e-3);
    CHECK_FALSE(lost.out.motion.tilt_known);
    BySonars stuck;
    stuck.lose_imu();
    CHECK(stuck.run(0.1, 0, 6, true).tilt_known);
    CHECK(stuck.state.level.since == doctest::Approx(2 * dt));
    CHECK_FALSE(stuck.run(0.1, 0, 8, true).tilt_known);
    CHECK(stuck.run(0.1, 0, 1).tilt_known);
  }

  TEST_CASE(
      "ranges are older than the lean that they show by 20 ms, while it turns and while it learns how they differ") {
    const auto lean_after = [](double age) {
      BySonars b{.param = {.sonars = {.age = age}}};
      b.lose_imu();
      for (int i = 1; i <= 12; ++i) b.run(0.02 * i, 0, 1);
      return b.out.motion.roll;
    };
    // it rolls by 0.02 rad each 45 ms, as it is told
    CHECK(lean_after(0.02) > lean_after(0) + 0.004);
    BySonars learns;
    learns.in.estimate.p = 0.5;
    learns.lose_imu(0.1 - 0.5 * 0.02, 0);
    CHECK(learns.state.level.roll == doctest::Approx(0.1).epsilon(0.02).scale(0));
  }

  TEST_CASE("what sonars show while the IMU reports otherwise, on a slope or after a trim, is no lean") {
    BySonars b;
    b.lose_imu(0.04, -0.03);
    CHECK(b.state.level.roll == doctest::Approx(0.04).epsilon(0.02).scale(0));
    CHECK(std::abs(b.run(0.04, -0.03, 30).roll) < 0.001);
    CHECK(b.run(0.14, -0.03, 30).roll == doctest::Approx(0.1).epsilon(0.1).scale(0));
    CHECK(std::abs(b.out.motion.pitch) < 0.002);
    // one reading does not change what was learnt for long
    BySonars silent;
    silent.lose_imu(0.04, 0);
    silent.in.estimate.rates_known = true;
    for (int i = 0; i < 200; ++i) BlindObserver::run(silent.param, tick, silent.in, silent.state, silent.out);
    silent.run(0.1, 0, 1);
    CHECK(silent.state.level.roll < 0.051);
    // nor does an IMU whose angles are wrong
    silent.in.estimate.attitude_known = false;
    silent.run(0.1, 0, 100);
    CHECK(silent.state.level.roll < 0.051);
  }

  TEST_CASE("they show it for 0.3 s after the last reading, also of one that turns round, which its lasers do not") {
    BySonars b;
    b.in.estimate.r = 1;
    b.lose_imu();
    b.run(0.01, 0, 1);
    CHECK(b.out.motion.turns);
    b.in.estimate.fixes[0] = b.in.estimate.fixes[1] = {.range = 8, .is_new = true};
    const auto wait = [&](int periods) {
      for (int i = 0; i < periods; ++i) BlindObserver::run(b.param, tick, b.in, b.state, b.out);
      return b.out.motion.known;
    };
    CHECK(wait(17));
    CHECK_FALSE(wait(2));
    CHECK_FALSE(b.out.motion.tilt_known);
  }

  TEST_CASE("the ground turns it as nobody foresees: there it follows the sonars sooner") {
    const auto follows = [](bool touches) {
      BySonars b;
      b.lose_imu();
      b.in.estimate.touches = touches;
      b.run(0.1, 0, 20);
      return b.run(0.2, 0, 1).roll - 0.1;
    };
    CHECK(follows(true) > 0.06);
    CHECK(follows(true) > 1.2 * follows(false));
  }

  TEST_CASE("what lasers see while it turns round is no fix of its place, and it is not seen then") {
    for (const bool turns : {false, true}) {
      jarol::tests::HeardHelicopter heard;
      heard.lift_to(1);
      heard.sensors.new_imu = false;
      heard.run(10);
      const BlindMotion blind{.lift = g_earth, .known = true, .tilt_known = true, .turns = turns};
      for (int i = 0; i < 120; ++i) {
        ++heard.sensors.answers;
        JaviatorFilter::run(heard.param, tick, {heard.sensors, heard.directive, blind}, heard.state, heard.out);
      }
      CHECK(heard.out.estimate.fixes[0].is_new != turns);
      CHECK(heard.out.estimate.position_known != turns);  // 1.8 s
    }
  }
}
