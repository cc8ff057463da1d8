#include "graph/math/powers.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "graph/math/functions.h"

namespace {
using Four = std::array<double, 4>;

bool same(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

int differing(const Four& x, double y) {
  const Four all = jarol::math::pow_each(x, y);
  int count = 0;
  for (std::size_t i = 0; i < 4; ++i) count += !same(all[i], pow(x[i], y));
  return count;
}
}  // namespace

TEST_SUITE("math/powers") {
  TEST_CASE("powers of several numbers at once are those of each, to the bit") {
    std::mt19937_64 bits(1);
    std::uniform_real_distribution<double> part(0.0, 1.0), exponent(-3.0, 3.0), size(-300.0, 300.0);
    const auto number = [&] { return std::pow(10.0, size(bits)); };
    int wrong = 0;
    for (int i = 0; i < 100'000; ++i) {
      wrong += differing({part(bits), part(bits), part(bits), part(bits)}, exponent(bits));
      wrong += differing({number(), number(), number(), number()}, exponent(bits));
    }
    CHECK(wrong == 0);
  }

  TEST_CASE("so they are where one of them is no ordinary number") {
    constexpr double inf = std::numeric_limits<double>::infinity(), NaN = std::numeric_limits<double>::quiet_NaN();
    const std::array odd{0.0, -0.0, 1.0, -1.0, -2.5, 0x1p-1030, 0x1p-1074, 0x1.8p1023, inf, -inf, NaN};
    const std::array exponents{0.0,      -0.0,      1.0,     2.0,      -3.0, 0.5, 1.415, 0x1p-80,
                               -0x1p-71, 0x1p-1074, 0x1p910, -0x1p950, 1e9,  inf, -inf,  NaN};
    for (const double y : exponents)
      for (const double x : odd)
        for (std::size_t place = 0; place < 4; ++place) {
          Four all{0.5, 0.75, 2.0, 1e200};
          all[place] = x;
          CAPTURE(x);
          CAPTURE(y);
          CHECK(differing(all, y) == 0);
        }
  }
}
