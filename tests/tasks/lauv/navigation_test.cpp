#include "tasks/lauv/navigation.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace {
using namespace jarol;
using namespace jarol::tasks;

const Tick every_50_ms{.period = std::chrono::milliseconds(50)};

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
  TEST_CASE("in a turn it tells heading, rate, speed and depth, and comes round to where it was") {
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
      i.depth.value = 5 + (k % 2 == 0 ? 0.1 : -0.1);
      LauvNavigation::run({}, every_50_ms, {i}, state, out);
      if (k > 50) CHECK(std::abs(out.motion.z - 5) < 0.02);
    }
    i.depth.value = 6;
    for (int k = 0; k < 100; ++k) LauvNavigation::run({}, every_50_ms, {i}, state, out);
    CHECK(out.motion.z == doctest::Approx(6).scale(0).epsilon(1e-3));
  }

  TEST_CASE("a climb shows in the depth before the gauge tells") {
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

  TEST_CASE("the first fix sets the place, later ones draw it near") {
    LauvNavigation::State state;
    LauvNavigation::Out out;
    Instruments i;
    i.place = {10, -20, 0, 1};
    LauvNavigation::run({}, every_50_ms, {i}, state, out);
    CHECK(out.motion.x == 10);
    CHECK(out.motion.y == -20);
    i.place = {15, -20, 0, 2};
    LauvNavigation::run({}, every_50_ms, {i}, state, out);
    CHECK(out.motion.x == doctest::Approx(11));
    LauvNavigation::run({}, every_50_ms, {i}, state, out);
    CHECK(out.motion.x == doctest::Approx(11));
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
}
