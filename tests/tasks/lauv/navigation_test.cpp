#include "tasks/lauv/navigation.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/tasks/lauv/every_50_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;

using tests::every_50_ms;

// Instruments of a vehicle that goes ahead at 1 m/s, 5 m deep, turning by 0.1 rad/s.
Instruments turning(int k) {
  Instruments i;
  const double psi = 0.1 * 0.05 * k;
  i.depth = {5, k + 1};
  i.attitude = {0, 0, std::remainder(psi, 2 * 3.14159265358979), k + 1};
  i.heading = {i.attitude.z, k + 1};
  i.rates = {0, 0, 0.1, k + 1};
  i.velocity = {1, 0, 0, k + 1};
  return i;
}
}  // namespace

TEST_SUITE("tasks/lauv_navigation") {
  TEST_CASE("in a turn it reports heading, rate, speed and depth, and comes round to where it was") {
    LauvNavigation::State state;
    LauvNavigation::Out out;
    for (int k = 0; k < 1500; ++k) {
      LauvNavigation::run({}, every_50_ms, {turning(k)}, state, out);
      if (k > 20) CHECK(std::abs(std::remainder(out.motion.psi - 0.005 * k, 2 * 3.14159265358979)) < 1e-3);
    }
    CHECK(out.motion.z == doctest::Approx(5));
    CHECK(out.motion.u == doctest::Approx(1));
    CHECK(out.motion.r == 0.1);
    // on the circle of 10 m about 10 m to starboard
    CHECK(std::hypot(out.motion.x, out.motion.y - 10) == doctest::Approx(10).scale(0).epsilon(0.03));
  }

  TEST_CASE("the depth gauge's noise is smoothed, its steps are followed") {
    LauvNavigation::State state;
    LauvNavigation::Out out;
    Instruments i = turning(0);
    for (int k = 0; k < 100; ++k) {
      i.depth = {5 + (k % 2 == 0 ? 0.1 : -0.1), i.depth.count + 1};
      LauvNavigation::run({}, every_50_ms, {i}, state, out);
      if (k > 50) CHECK(std::abs(out.motion.z - 5) < 0.02);
    }
    for (int k = 0; k < 100; ++k) {
      i.depth = {6, i.depth.count + 1};
      LauvNavigation::run({}, every_50_ms, {i}, state, out);
    }
    CHECK(out.motion.z == doctest::Approx(6).scale(0).epsilon(1e-3));
  }

  TEST_CASE("without a compass the heading is the IMU's, without a depth gauge the depth is that of the pressure") {
    LauvNavigation::State state;
    LauvNavigation::Out out;
    for (int k = 0; k < 100; ++k) {
      Instruments i = turning(k);
      i.heading = {0, -1};
      i.depth = {0, -1};
      i.pressure = {1013.25 + 98.1 * 5, k + 1};
      LauvNavigation::run({}, every_50_ms, {i}, state, out);
    }
    CHECK(out.motion.psi == doctest::Approx(0.005 * 99).scale(0).epsilon(1e-3));
    CHECK(out.motion.z == doctest::Approx(5));
  }

  TEST_CASE("a climb shows in the depth before the gauge reports") {
    LauvNavigation::State state;
    LauvNavigation::Out out;
    Instruments i = turning(0);
    i.rates = {};
    LauvNavigation::run({}, every_50_ms, {i}, state, out);
    i.attitude.y = 0.3;
    for (int k = 0; k < 40; ++k) LauvNavigation::run({}, every_50_ms, {i}, state, out);
    // 1 m/s, 0.3 rad nose up: the filter settles where gauge and motion pull alike
    CHECK(out.motion.z == doctest::Approx(5 - 0.7 * std::sin(0.3)).scale(0).epsilon(0.01));
  }

  TEST_CASE("the first fix sets the place, the next counts half, and nobody knows the place before") {
    LauvNavigation::State state;
    LauvNavigation::Out out;
    Instruments i;
    i.beacons[0] = {0, 100, 0, 30, 1};
    LauvNavigation::run({}, every_50_ms, {i}, state, out);
    CHECK(out.motion.x == 0);
    CHECK(out.motion.y == 0);
    CHECK_FALSE(out.accuracy.known);
    CHECK(out.accuracy.left_out == 0);
    i.place = {10, -20, 0, 1};
    LauvNavigation::run({}, every_50_ms, {i}, state, out);
    CHECK(out.motion.x == 10);
    CHECK(out.motion.y == -20);
    CHECK(out.accuracy.known);
    CHECK(out.accuracy.deviation == doctest::Approx(2.5 * std::sqrt(2)));
    i.place = {15, -20, 0, 2};
    LauvNavigation::run({}, every_50_ms, {i}, state, out);
    CHECK(out.motion.x == doctest::Approx(12.5));
    CHECK(out.accuracy.deviation == doctest::Approx(2.5));
    LauvNavigation::run({}, every_50_ms, {i}, state, out);
    CHECK(out.motion.x == doctest::Approx(12.5));
  }

  TEST_CASE("each instrument is followed over its own time") {
    LauvNavigation::State state;
    LauvNavigation::Out out;
    Instruments i = turning(0);
    i.rates = {};
    i.velocity = {};
    LauvNavigation::run({}, every_50_ms, {i}, state, out);
    i.depth.value += 0.1;
    i.attitude.x = 0.01;
    i.attitude.y = -0.01;
    i.heading.value = 0.01;
    i.velocity = {0.1, 0.2, 0.3, 2};
    LauvNavigation::run({}, every_50_ms, {i}, state, out);
    CHECK(out.motion.z == doctest::Approx(5 + 0.1 * 0.05 / 0.7));
    CHECK(out.motion.phi == doctest::Approx(0.01 * 0.05 / 0.5));
    CHECK(out.motion.theta == doctest::Approx(-0.01 * 0.05 / 0.5));
    CHECK(out.motion.psi == doctest::Approx(0.01 * 0.05 / 0.5));
    CHECK(out.motion.u == doctest::Approx(0.1 * 0.05 / 0.2));
    CHECK(out.motion.v == doctest::Approx(0.2 * 0.05 / 0.2));
    CHECK(out.motion.w == doctest::Approx(0.3 * 0.05 / 0.2));
  }

  TEST_CASE("in any attitude it moves and turns as rotations have it") {
    LauvNavigation::Param rates_only;
    rates_only.angle_time = rates_only.depth_time = rates_only.speed_time = 1e9;
    const Tick every_us{.period = std::chrono::microseconds(1)};
    const double dt = 1e-6;
    for (const double phi : {-0.9, 0.0, 0.7}) {
      for (const double theta : {-0.5, 0.0, 0.8}) {
        for (const double psi : {-2.5, 0.0, 1.2}) {
          const Eigen::Vector3d v_b(1, -0.6, 0.4), omega_b(0.2, -0.3, 0.5);
          LauvNavigation::State state{.started = true};
          Motion& m = state.motion;
          m.phi = phi;
          m.theta = theta;
          m.psi = psi;
          m.u = v_b.x();
          m.v = v_b.y();
          m.w = v_b.z();
          m.p = omega_b.x();
          m.q = omega_b.y();
          m.r = omega_b.z();
          // R_nb from roll, pitch and yaw (Fossen 2011, 2.18)
          const auto rotation = [&] {
            return (Eigen::AngleAxisd(m.psi, Eigen::Vector3d::UnitZ()) *
                    Eigen::AngleAxisd(m.theta, Eigen::Vector3d::UnitY()) *
                    Eigen::AngleAxisd(m.phi, Eigen::Vector3d::UnitX()))
                .toRotationMatrix();
          };
          const Eigen::Matrix3d before = rotation();
          LauvNavigation::Out out;
          LauvNavigation::run(rates_only, every_us, {}, state, out);
          const Eigen::Vector3d moved(out.motion.x, out.motion.y, out.motion.z);
          CHECK((moved / dt - before * v_b).norm() < 1e-6);
          const Eigen::AngleAxisd turned(before.transpose() * rotation());
          CHECK((turned.axis() * turned.angle() / dt - omega_b).norm() < 1e-5);
        }
      }
    }
  }

  // At rest in the water of a current, at the surface or deep, with exact instruments.
  struct Drifting {
    double north, east;
    Instruments i = turning(0);
    LauvNavigation::State state{};
    LauvNavigation::Out out{};
    int k = 0;

    Drifting(double c_north, double c_east) : north(c_north), east(c_east) {
      i.rates = {};
      i.velocity = {};
    }
    double x() const { return 0.05 * k * north; }
    double y() const { return 0.05 * k * east; }
    void fix(double off = 0) { i.place = {x() + off, y(), 0, i.place.count + 1}; }
    void range(std::size_t beacon, double at_north, double at_east, double off = 0) {
      const double away = std::hypot(x() - at_north, y() - at_east, 15 - i.depth.value);
      i.beacons[beacon] = {at_north, at_east, 15, away + off, i.beacons[beacon].count + 1};
    }
    void step() {
      ++k;
      ++i.depth.count;
      LauvNavigation::run({}, every_50_ms, {i}, state, out);
    }
    double error() const { return std::hypot(out.motion.x - x(), out.motion.y - y()); }
  };

  TEST_CASE("what GPS sees of the drift is the current") {
    Drifting boat(0.3, -0.1);
    for (int second = 0; second < 60; ++second) {
      boat.fix();
      for (int k = 0; k < 20; ++k) boat.step();
    }
    CHECK(boat.out.stream.north == doctest::Approx(0.3).scale(0).epsilon(0.03));
    CHECK(boat.out.stream.east == doctest::Approx(-0.1).scale(0).epsilon(0.03));
    // and is reckoned with when GPS is gone
    const double before = boat.error();
    for (int k = 0; k < 1200; ++k) boat.step();
    CHECK(boat.error() < before + 0.6);
  }

  TEST_CASE("two beacons report place and current under water, from below and aside") {
    Drifting boat(-0.2, 0.3);
    boat.i.depth.value = 0;
    boat.fix();
    boat.step();
    boat.i.depth.value = 5;
    for (int step = 0; step < 100; ++step) {
      boat.range(0, -30, -60);
      boat.range(1, 130, -60);
      for (int k = 0; k < 40; ++k) boat.step();
    }
    CHECK(boat.error() < 0.1);
    CHECK(boat.out.stream.north == doctest::Approx(-0.2).scale(0).epsilon(0.01));
    CHECK(boat.out.stream.east == doctest::Approx(0.3).scale(0).epsilon(0.01));
    CHECK(boat.out.accuracy.deviation < 1.5);
    CHECK(boat.out.accuracy.left_out == 0);
  }

  TEST_CASE("a fix or a range that fits nothing is left out and counted, and ten such fixes in a row are believed") {
    Drifting boat(0, 0);
    for (int second = 0; second < 30; ++second) {
      boat.fix();
      boat.range(0, -30, -60);
      for (int k = 0; k < 20; ++k) boat.step();
    }
    const double before = boat.error();
    boat.fix(15);
    boat.range(0, -30, -60, 8);
    boat.step();
    CHECK(boat.out.accuracy.left_out == 2);
    CHECK(boat.error() < before + 0.02);
    boat.fix(1);
    boat.range(0, -30, -60, 1);
    boat.step();
    CHECK(boat.out.accuracy.left_out == 2);
    for (int fix = 0; fix < 10; ++fix) {
      boat.fix(100);
      boat.step();
    }
    CHECK(boat.out.accuracy.left_out == 12);
    CHECK(boat.error() < 2);
    boat.fix(100);
    boat.step();
    CHECK(boat.out.motion.x == doctest::Approx(100));
    CHECK(boat.out.stream.north == 0);
  }

  TEST_CASE("the place filter is a Kalman filter: a step and a range by hand") {
    const PlaceFilter::Model model{.drift = 0.1, .change = 0.01, .current = 0.5, .fix = 2, .range = 1, .gate = 3};
    PlaceFilter filter;
    filter.begin(model, 3, 4);
    filter.predict(model, 1, -2, 2);
    CHECK(filter.s[0] == 5);
    CHECK(filter.s[1] == 0);
    // P_xx = 4 + 2^2 0.25 + 0.01 2, P_xc = 2 0.25, P_cc = 0.25 + 1e-4 2
    CHECK(filter.P[0] == doctest::Approx(5.02));
    CHECK(filter.P[2] == doctest::Approx(0.5));
    CHECK(filter.P[8] == doctest::Approx(0.5));
    CHECK(filter.P[10] == doctest::Approx(0.2502));
    CHECK(filter.P[1] == 0);
    // 3-4-5 on the ground and 12 below: h = (4, -3)/13, S = 5.02 25/169 + 1
    REQUIRE(filter.take_range(model, 1, 3, 12, 14));
    const double S = 5.02 * 25 / 169 + 1;
    CHECK(filter.s[0] == doctest::Approx(5 + 5.02 * 4 / 13 / S));
    CHECK(filter.s[1] == doctest::Approx(-5.02 * 3 / 13 / S));
    CHECK(filter.s[2] == doctest::Approx(0.5 * 4 / 13 / S));
    CHECK(filter.P[0] == doctest::Approx(5.02 - 5.02 * 5.02 * 16 / 169 / S));
    CHECK(filter.P[1] == doctest::Approx(5.02 * 5.02 * 12 / 169 / S));
    CHECK(filter.P[4] == filter.P[1]);
    // three deviations and no more
    PlaceFilter there;
    there.begin(model, 5, 0);
    CHECK_FALSE(there.take_fix(model, 5, 3.01 * std::sqrt(8)));
    CHECK_FALSE(there.take_fix(model, -3.01 * std::sqrt(8) + 5, 0));
    CHECK(there.s[1] == 0);
    CHECK(there.take_fix(model, 5, 2.99 * std::sqrt(8)));
    CHECK_FALSE(there.take_range(model, 5, there.s[1], 0, 1));
  }
}
