#include "tasks/lauv_navigation.h"

#include <doctest/doctest.h>

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
    CHECK(std::hypot(out.motion.x, out.motion.y - 10) == doctest::Approx(10).epsilon(0.03));
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
    CHECK(out.motion.z == doctest::Approx(6).epsilon(1e-3));
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
    CHECK(out.motion.z == doctest::Approx(5 - 0.7 * std::sin(0.3)).epsilon(0.01));
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
}
