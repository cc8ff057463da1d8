// Each function against MPFR, over ranges that reach all of its ways; 10^7 arguments each with JAROL_FULL.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "graph/math/functions.h"
#include "tests/graph/math/reference.h"
#include "tests/how_many.h"

namespace {

struct Range {
  double from, to;
};

struct Both {
  Range x, y;
};

struct Random {
  std::uint64_t state;
  std::uint64_t next() {
    state += 0x9e3779b97f4a7c15;
    std::uint64_t z = state;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
  }
  // half of them even over the range, half of them even over its exponents
  double in(Range range) {
    const double unit = static_cast<double>(next() >> 11) * 0x1p-53;
    if (next() & 1 || range.from < 0.0) return range.from + (range.to - range.from) * unit;
    const auto low = std::bit_cast<std::uint64_t>(range.from), high = std::bit_cast<std::uint64_t>(range.to);
    return std::bit_cast<double>(low + next() % (high - low + 1));
  }
};

long arguments() { return jarol::tests::how_many(20'000, 10'000'000); }

struct Worst {
  double error = 0.0, x = 0.0, y = 0.0;
  long finite = 0;  // results that are neither infinite nor no number
  void take(double found, double result, double at, double and_at = 0.0) {
    finite += std::isfinite(result) ? 1 : 0;
    if (found > error) error = found, x = at, y = and_at;
  }
};

Worst worst(double (*ours)(double), reference::Of1 exact, const std::vector<Range>& ranges, bool odd_or_even) {
  Random random{1};
  reference::Number x, result;
  Worst worst;
  for (long i = 0; i < arguments(); ++i) {
    double at = random.in(ranges[static_cast<std::size_t>(i) % ranges.size()]);
    if (odd_or_even && random.next() & 1) at = -at;
    mpfr_set_d(x.value, at, MPFR_RNDN);
    exact(result.value, x.value, MPFR_RNDN);
    const double found = ours(at);
    worst.take(reference::ulps(found, result), found, at);
  }
  return worst;
}

Worst worst(double (*ours)(double, double), reference::Of2 exact, const std::vector<Both>& ranges) {
  Random random{2};
  reference::Number x, y, result;
  Worst worst;
  for (long i = 0; i < arguments(); ++i) {
    const auto& range = ranges[static_cast<std::size_t>(i) % ranges.size()];
    const double at = random.in(range.x), and_at = random.in(range.y);
    mpfr_set_d(x.value, at, MPFR_RNDN);
    mpfr_set_d(y.value, and_at, MPFR_RNDN);
    exact(result.value, x.value, y.value, MPFR_RNDN);
    const double found = ours(at, and_at);
    worst.take(reference::ulps(found, result), found, at, and_at);
  }
  return worst;
}

constexpr double min = 5e-324, greatest = 1.7976931348623157e308;

void check(const std::string& name, const Worst& worst, double limit) {
  INFO(name << " at " << worst.x << ", " << worst.y << ": " << worst.error << " ulp");
  if (jarol::tests::is_full() || std::getenv("VERBOSE"))
    MESSAGE(name << " " << worst.error << " ulp at " << worst.x << ", " << worst.y);
  CHECK(worst.error <= limit);
  // of so many results that are rounded some are nearly half a unit off: less says that little was compared
  CHECK(worst.error > 0.49);
  CHECK(worst.finite > arguments() / 2);
}

}  // namespace

TEST_SUITE("graph/math") {
  TEST_CASE("functions of the circle are within their errors of MPFR's") {
    const std::vector<Range> angles{{min, 0.13}, {0.13, 0.8}, {0.7, 10.0}, {1.0, 0x1p20}, {0x1p20, greatest}};
    check("sin", worst(sin, mpfr_sin, angles, true), 0.55);
    check("cos", worst(cos, mpfr_cos, angles, true), 0.55);
    check("tan", worst(tan, mpfr_tan, angles, true), 0.55);
  }

  TEST_CASE("arcs are within their errors of MPFR's") {
    const std::vector<Range> units{{min, 1e-3}, {1e-3, 0.5}, {0.5, 1.0}, {0.999, 1.0}};
    check("asin", worst(asin, mpfr_asin, units, true), 0.51);
    check("acos", worst(acos, mpfr_acos, units, true), 0.51);
    check("atan", worst(atan, mpfr_atan, {{min, 1.0}, {0.01, 1.0}, {1.0, 100.0}, {1.0, greatest}}, true), 0.51);
    const Range all{min, greatest}, ordinary{1e-3, 1e3}, negative{-1e3, -1e-3}, wide{-1.0, 1.0};
    check("atan2",
          worst(atan2, mpfr_atan2,
                {{all, all},
                 {ordinary, ordinary},
                 {negative, negative},
                 {wide, wide},
                 {{min, 1e-300}, {min, 1e-300}},
                 {{1e300, greatest}, {1e300, greatest}}}),
          0.51);
  }

  TEST_CASE("exponentials are within their errors of MPFR's") {
    // the last range ends where doubles lose bits
    const std::vector<Range> both{{min, 1e-3},   {1e-3, 1.0},     {-1.0, 1.0},
                                  {-50.0, 50.0}, {-746.0, 710.0}, {-708.5, -708.3}};
    check("exp", worst(exp, mpfr_exp, both, false), 0.52);
    check("exp2", worst(exp2, mpfr_exp2, {{min, 1.0}, {-1.0, 1.0}, {-1076.0, 1024.0}, {-1022.1, -1021.9}}, false),
          0.51);
    check("exp10", worst(exp10, mpfr_exp10, {{min, 1.0}, {-1.0, 1.0}, {-325.0, 309.0}, {-307.7, -307.6}}, false), 0.51);
    check("expm1", worst(expm1, mpfr_expm1, both, true), 0.52);
    check("sinh", worst(sinh, mpfr_sinh, {{min, 0.1}, {0.01, 1.0}, {1.0, 50.0}, {50.0, 711.0}}, true), 0.52);
    check("cosh", worst(cosh, mpfr_cosh, {{min, 0.1}, {0.01, 1.0}, {1.0, 50.0}, {50.0, 711.0}}, true), 0.52);
    check("tanh", worst(tanh, mpfr_tanh, {{min, 0.1}, {0.01, 1.0}, {0.0625, 3.0}, {1.0, 25.0}}, true), 0.52);
  }

  TEST_CASE("logarithms are within their errors of MPFR's") {
    const std::vector<Range> positive{{min, greatest}, {0.5, 2.0}, {0.99, 1.01}, {1.0, 1e6}};
    check("log", worst(log, mpfr_log, positive, false), 0.53);
    check("log2", worst(log2, mpfr_log2, positive, false), 0.51);
    check("log10", worst(log10, mpfr_log10, positive, false), 0.51);
    check("log1p", worst(log1p, mpfr_log1p, {{-1.0, 1.0}, {-0.01, 0.01}, {min, greatest}, {-0.001, 0.001}}, false),
          0.53);
    check("asinh", worst(asinh, mpfr_asinh, {{min, 0.1}, {0.01, 10.0}, {1.0, greatest}}, true), 0.52);
    check("acosh", worst(acosh, mpfr_acosh, {{1.0, 1.001}, {1.0, 10.0}, {1.0, greatest}}, false), 0.52);
    check("atanh", worst(atanh, mpfr_atanh, {{min, 0.1}, {0.01, 1.0}, {0.9, 1.0}}, true), 0.52);
  }

  TEST_CASE("powers and roots are within their errors of MPFR's") {
    const Range all{min, greatest};
    const Range reals{-300.0, 300.0};
    check("pow",
          worst(pow, mpfr_pow,
                {{{0.1, 10.0}, reals},
                 {{0.9, 1.1}, {-5000.0, 5000.0}},
                 {all, {-1.1, 1.1}},
                 {all, {-2.0, 3.0}},
                 {{0.9999, 1.0001}, {-1e7, 1e7}}}),
          0.54);
    check("cbrt", worst(cbrt, mpfr_cbrt, {{min, greatest}, {1.0, 8.0}}, true), 0.51);
    check("hypot", worst(hypot, mpfr_hypot, {{reals, reals}, {{1e-3, 1e3}, {1e-9, 1e3}}, {all, all}}), 0.51);
    check("subnormal hypot", worst(hypot, mpfr_hypot, {{{min, 1e-308}, {min, 1e-308}}}), 1.0);
  }
}
