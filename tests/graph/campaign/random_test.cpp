// Random numbers of campaigns, beside what others have found.
#include "graph/campaign/random.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace jarol::campaign;

namespace {
// Phi(x), by the series of its integral: Abramowitz and Stegun, 26.2.11.
double normal_below(double x) {
  double term = x, sum = x;
  for (int i = 1; i < 400; ++i) sum += term *= x * x / (2 * i + 1);
  return 0.5 + sum * std::exp(-x * x / 2) / std::sqrt(2 * std::acos(-1.0));
}
}  // namespace

TEST_SUITE("graph/campaign/random") {
  TEST_CASE("the sequence is that of splitmix64") {
    // the first numbers of the seeds 0 and 1234567 as its authors' program prints them
    CHECK(random_bits(0, 0) == 0xe220a8397b1dcdafU);
    CHECK(random_bits(0, 1) == 0x6e789e6aa1b965f4U);
    CHECK(random_bits(1234567, 0) == 6457827717110365317U);
    CHECK(random_bits(1234567, 4) == 16408922859458223821U);
  }

  TEST_CASE("a part of the whole is never its begin or its end") {
    CHECK(part_of(0) == 0x1p-53);
    CHECK(part_of(~std::uint64_t{0}) == 1 - 0x1p-53);
  }

  TEST_CASE("the normal distribution below its quantile has that part") {
    for (int i = 1; i < 1000; ++i) {
      const double part = i / 1000.0;
      CHECK(std::abs(normal_below(normal_quantile(part)) - part) < 1e-14);
    }
  }

  TEST_CASE("quantiles are those that Python's statistics.NormalDist finds") {
    CHECK(normal_quantile(0.5) == 0);
    CHECK(normal_quantile(0.1) == doctest::Approx(-1.2815515655446008).scale(0).epsilon(1e-15));
    CHECK(normal_quantile(0.075) == doctest::Approx(-1.4395314709384557).scale(0).epsilon(1e-15));
    CHECK(normal_quantile(0.92) == doctest::Approx(1.4050715603096327).scale(0).epsilon(1e-15));
    CHECK(normal_quantile(0.025) == doctest::Approx(-1.9599639845400538).scale(0).epsilon(1e-15));
    CHECK(normal_quantile(1e-5) == doctest::Approx(-4.2648907939228256).scale(0).epsilon(1e-15));
    CHECK(normal_quantile(1e-12) == doctest::Approx(-7.034483825301132).scale(0).epsilon(1e-15));
    CHECK(normal_quantile(1e-300) == doctest::Approx(-37.0470962993612).scale(0).epsilon(1e-15));
  }
}
