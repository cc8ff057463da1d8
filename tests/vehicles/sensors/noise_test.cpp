// Random numbers against their definitions and their distributions.
#include "vehicles/sensors/noise.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "graph/values/digest.h"

namespace {
using namespace jarol;
using namespace jarol::vehicles;
}  // namespace

TEST_SUITE("vehicles/noise") {
  TEST_CASE("a uniform draw is the upper 53 bits of the digest's key of seed and number, in the middle of its step") {
    Noise noise(7);
    for (std::uint64_t i = 0; i < 100; ++i) {
      const long double expected = (static_cast<long double>(digest::key(7 + i) >> 11) + 0.5L) / 9007199254740992.0L;
      CHECK(noise.uniform() == static_cast<double>(expected));
    }
  }

  TEST_CASE("a normal draw is Box and Muller's of two uniform ones") {
    Noise normal(3), uniform(3);
    for (int i = 0; i < 1000; ++i) {
      const long double u = uniform.uniform(), v = uniform.uniform();
      const long double expected = std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi_v<long double> * v);
      CHECK(std::abs(normal.normal() - static_cast<double>(expected)) < 1e-14);
    }
  }

  TEST_CASE("normal draws have mean 0, deviation 1, and as many beyond 1 and 2 as they should") {
    Noise noise(11);
    const int count = 200000;
    double sum = 0, squares = 0;
    int beyond_1 = 0, beyond_2 = 0;
    for (int i = 0; i < count; ++i) {
      const double x = noise.normal();
      sum += x;
      squares += x * x;
      beyond_1 += x > 1;
      beyond_2 += x < -2;
    }
    // four standard errors
    CHECK(std::abs(sum / count) < 4 / std::sqrt(count));
    CHECK(std::abs(squares / count - 1) < 4 * std::sqrt(2.0 / count));
    CHECK(std::abs(1.0 * beyond_1 / count - 0.158655) < 4 * std::sqrt(0.158655 * 0.841345 / count));
    CHECK(std::abs(1.0 * beyond_2 / count - 0.022750) < 4 * std::sqrt(0.022750 * 0.977250 / count));
  }
}
