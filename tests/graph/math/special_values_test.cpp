// Zeros with their signs, infinities, NaN, ends of domains, as C's Annex F wants them; values that are exact; single
// precision.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "graph/math/functions.h"
#include "tests/graph/math/reference.h"

namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double half_pi = 0x1.921fb54442d18p+0, pi = 0x1.921fb54442d18p+1;

struct Case1 {
  std::string name;
  double (*function)(double);
  double x, value;
};

struct Case2 {
  std::string name;
  double (*function)(double, double);
  double x, y, value;
};

bool same(double a, double b) { return std::isnan(a) ? std::isnan(b) : a == b && std::signbit(a) == std::signbit(b); }

}  // namespace

TEST_SUITE("graph/math") {
  TEST_CASE("what has a sign keeps it at zero, and NaN stays NaN") {
    const std::vector<Case1> odd{{"sin", sin, 0, 0},     {"tan", tan, 0, 0},     {"asin", asin, 0, 0},
                                 {"atan", atan, 0, 0},   {"sinh", sinh, 0, 0},   {"tanh", tanh, 0, 0},
                                 {"asinh", asinh, 0, 0}, {"atanh", atanh, 0, 0}, {"expm1", expm1, 0, 0},
                                 {"log1p", log1p, 0, 0}};
    for (const Case1& c : odd) {
      INFO(c.name);
      CHECK(same(c.function(0.0), 0.0));
      CHECK(same(c.function(-0.0), -0.0));
      CHECK(same(c.function(5e-324), 5e-324));
      CHECK(std::isnan(c.function(NaN)));
    }
    CHECK((same(cbrt(0.0), 0.0) && same(cbrt(-0.0), -0.0) && std::isnan(cbrt(NaN))));
    for (const auto function : {cos, acos, cosh, acosh, exp, exp2, exp10, log, log2, log10})
      CHECK(std::isnan(function(NaN)));
    for (const auto function : {cos, cosh, exp, exp2, exp10}) {
      CHECK(function(0.0) == 1.0);
      CHECK(function(-0.0) == 1.0);
      CHECK(function(5e-324) == 1.0);
    }
  }

  TEST_CASE("at infinity and at the ends of domains stands what Annex F says") {
    const std::vector<Case1> cases{
        {"sin", sin, inf, NaN},        {"cos", cos, -inf, NaN},      {"tan", tan, inf, NaN},
        {"asin", asin, 1, half_pi},    {"asin", asin, -1, -half_pi}, {"asin", asin, 1.1, NaN},
        {"acos", acos, 1, 0},          {"acos", acos, -1, pi},       {"acos", acos, 0, half_pi},
        {"acos", acos, -1.1, NaN},     {"atan", atan, inf, half_pi}, {"atan", atan, -inf, -half_pi},
        {"sinh", sinh, inf, inf},      {"sinh", sinh, -inf, -inf},   {"sinh", sinh, -711, -inf},
        {"cosh", cosh, -inf, inf},     {"cosh", cosh, -711, inf},    {"tanh", tanh, inf, 1},
        {"tanh", tanh, -inf, -1},      {"tanh", tanh, 400, 1},       {"asinh", asinh, -inf, -inf},
        {"asinh", asinh, inf, inf},    {"acosh", acosh, 1, 0},       {"acosh", acosh, 0.9, NaN},
        {"acosh", acosh, inf, inf},    {"acosh", acosh, -inf, NaN},  {"atanh", atanh, 1, inf},
        {"atanh", atanh, -1, -inf},    {"atanh", atanh, 1.1, NaN},   {"exp", exp, inf, inf},
        {"exp", exp, -inf, 0},         {"exp", exp, 710, inf},       {"exp", exp, -746, 0},
        {"exp", exp, -745.13, 5e-324}, {"exp2", exp2, 1024, inf},    {"exp2", exp2, -1074, 5e-324},
        {"exp2", exp2, -1076, 0},      {"exp2", exp2, -inf, 0},      {"exp10", exp10, inf, inf},
        {"exp10", exp10, -400, 0},     {"expm1", expm1, inf, inf},   {"expm1", expm1, -inf, -1},
        {"expm1", expm1, -800, -1},    {"expm1", expm1, 710, inf},   {"log", log, 0, -inf},
        {"log", log, -0.0, -inf},      {"log", log, 1, 0},           {"log", log, inf, inf},
        {"log", log, -1, NaN},         {"log", log, -inf, NaN},      {"log2", log2, 0, -inf},
        {"log2", log2, -1, NaN},       {"log10", log10, -0.0, -inf}, {"log10", log10, inf, inf},
        {"log1p", log1p, -1, -inf},    {"log1p", log1p, -1.1, NaN},  {"log1p", log1p, inf, inf},
        {"log1p", log1p, -inf, NaN},   {"cbrt", cbrt, inf, inf},     {"cbrt", cbrt, -inf, -inf}};
    for (const Case1& c : cases) {
      INFO(c.name << "(" << c.x << ") is " << c.function(c.x) << ", not " << c.value);
      CHECK(same(c.function(c.x), c.value));
    }
  }

  TEST_CASE("functions of two numbers hold to Annex F") {
    const std::vector<Case2> cases{{"pow", pow, 0, -3, inf},
                                   {"pow", pow, -0.0, -3, -inf},
                                   {"pow", pow, -0.0, -2, inf},
                                   {"pow", pow, -0.0, -2.5, inf},
                                   {"pow", pow, -0.0, 3, -0.0},
                                   {"pow", pow, -0.0, 4, 0},
                                   {"pow", pow, 0, 0.5, 0},
                                   {"pow", pow, -1, inf, 1},
                                   {"pow", pow, -1, -inf, 1},
                                   {"pow", pow, 1, NaN, 1},
                                   {"pow", pow, NaN, 0, 1},
                                   {"pow", pow, NaN, -0.0, 1},
                                   {"pow", pow, NaN, 1, NaN},
                                   {"pow", pow, 2, NaN, NaN},
                                   {"pow", pow, -2, 0.5, NaN},
                                   {"pow", pow, 0.5, -inf, inf},
                                   {"pow", pow, 2, -inf, 0},
                                   {"pow", pow, 0.5, inf, 0},
                                   {"pow", pow, -2, inf, inf},
                                   {"pow", pow, -inf, -3, -0.0},
                                   {"pow", pow, -inf, -2, 0},
                                   {"pow", pow, -inf, 3, -inf},
                                   {"pow", pow, -inf, 2.5, inf},
                                   {"pow", pow, inf, -1, 0},
                                   {"pow", pow, inf, 0.1, inf},
                                   {"pow", pow, -2, 3, -8},
                                   {"pow", pow, -2, 4, 16},
                                   {"pow", pow, -2, 1e300, inf},
                                   {"pow", pow, -0.5, 1e300, 0},
                                   {"pow", pow, 10, 22, 1e22},
                                   {"pow", pow, 10, -400, 0},
                                   {"pow", pow, -10, 401, -inf},
                                   {"pow", pow, 2, -1074, 5e-324},
                                   {"pow", pow, 5, 1e-300, 1},
                                   {"pow", pow, 0, inf, 0},
                                   {"pow", pow, 0, -inf, inf},
                                   {"pow", pow, 3, 2, 9},
                                   {"pow", pow, -0.0, 2, 0},
                                   {"pow", pow, -inf, 2, inf},
                                   {"pow", pow, NaN, 2, NaN},
                                   {"atan2", atan2, 0, -0.0, pi},
                                   {"atan2", atan2, -0.0, -0.0, -pi},
                                   {"atan2", atan2, 0, 0, 0},
                                   {"atan2", atan2, -0.0, 0, -0.0},
                                   {"atan2", atan2, -0.0, -1, -pi},
                                   {"atan2", atan2, -0.0, 1, -0.0},
                                   {"atan2", atan2, -1, 0, -half_pi},
                                   {"atan2", atan2, 1, -0.0, half_pi},
                                   {"atan2", atan2, 1, -inf, pi},
                                   {"atan2", atan2, -1, inf, -0.0},
                                   {"atan2", atan2, inf, 1, half_pi},
                                   {"atan2", atan2, inf, -inf, 0.75 * pi},
                                   {"atan2", atan2, -inf, inf, -0.5 * half_pi},
                                   {"atan2", atan2, NaN, 1, NaN},
                                   {"atan2", atan2, 1, NaN, NaN},
                                   {"atan2", atan2, 1e-300, 1e300, 0},
                                   {"atan2", atan2, 5e-324, -1e300, pi},
                                   {"atan2", atan2, 1e300, 5e-324, half_pi},
                                   {"atan2", atan2, 5e-324, 5e-324, 0.5 * half_pi},
                                   {"hypot", hypot, inf, NaN, inf},
                                   {"hypot", hypot, NaN, -inf, inf},
                                   {"hypot", hypot, NaN, 1, NaN},
                                   {"hypot", hypot, -3, 4, 5},
                                   {"hypot", hypot, 0, -0.0, 0},
                                   {"hypot", hypot, 5e-324, 0, 5e-324},
                                   {"hypot", hypot, 1.5e308, 1.5e308, inf},
                                   {"hypot", hypot, 3e-310, 4e-310, 5e-310}};
    for (const Case2& c : cases) {
      INFO(c.name << "(" << c.x << ", " << c.y << ") is " << c.function(c.x, c.y) << ", not " << c.value);
      CHECK(same(c.function(c.x, c.y), c.value));
    }
  }

  TEST_CASE("powers of two and of ten, cubes and squares are exact") {
    for (int i = -1074; i < 1024; ++i) {
      CHECK(exp2(i) == std::ldexp(1.0, i));
      CHECK(log2(std::ldexp(1.0, i)) == i);
      CHECK(pow(2.0, i) == std::ldexp(1.0, i));
    }
    double ten = 1.0;
    for (int i = 0; i <= 22; ++i, ten *= 10.0) {
      CHECK(exp10(i) == ten);
      CHECK(log10(ten) == i);
      CHECK(pow(10.0, i) == ten);
    }
    for (int i = 1; i < 2000; ++i) {
      CHECK(cbrt(double(i) * i * i) == i);
      CHECK(pow(i, 3.0) == double(i) * i * i);
      CHECK(pow(double(i) * i, 0.5) == i);
      CHECK(hypot(3.0 * i, 4.0 * i) == 5.0 * i);
    }
  }

  TEST_CASE("sine and cosine of one call are those of two, near multiples of pi/2 and far out too") {
    // the double that comes nearest to a multiple of pi/2: 6381956970095103 2^797
    for (const double x :
         {0.3, 1.5707963267948966, 3.141592653589793, 1e5, 823549.6645, 1e22, 0x1.6ac5b262ca1ffp849, 1.7e308}) {
      double s = 0, c = 0;
      sincos(x, &s, &c);
      CHECK(s == sin(x));
      CHECK(c == cos(x));
      sincos(-x, &s, &c);
      CHECK(s == -sin(x));
      CHECK(c == cos(x));
    }
    CHECK(cos(0x1.6ac5b262ca1ffp849) == doctest::Approx(-4.687165924254624e-19).scale(0).epsilon(1e-15));
    CHECK(cos(1.5707963267948966) == 6.123233995736766e-17);
    CHECK(sin(3.141592653589793) == 1.2246467991473532e-16);
    double s = 1, c = 1;
    sincos(inf, &s, &c);
    CHECK((std::isnan(s) && std::isnan(c)));
    sincos(-0.0, &s, &c);
    CHECK((same(s, -0.0) && c == 1.0));
  }

  TEST_CASE("single precision is that of doubles, rounded") {
    const std::vector<std::pair<float (*)(float), reference::Of1>> functions{
        {sinf, mpfr_sin},   {cosf, mpfr_cos},     {tanf, mpfr_tan},     {asinf, mpfr_asin},   {acosf, mpfr_acos},
        {atanf, mpfr_atan}, {sinhf, mpfr_sinh},   {coshf, mpfr_cosh},   {tanhf, mpfr_tanh},   {asinhf, mpfr_asinh},
        {expf, mpfr_exp},   {exp2f, mpfr_exp2},   {exp10f, mpfr_exp10}, {expm1f, mpfr_expm1}, {logf, mpfr_log},
        {log2f, mpfr_log2}, {log10f, mpfr_log10}, {log1pf, mpfr_log1p}, {cbrtf, mpfr_cbrt},   {atanhf, mpfr_atanh}};
    reference::Number x, value;
    for (int i = 1; i < 1000; ++i)
      for (const auto& [ours, exact] : functions) {
        mpfr_set_d(x.value, static_cast<float>(i) / 1003.0f, MPFR_RNDN);
        exact(value.value, x.value, MPFR_RNDN);
        CHECK(ours(static_cast<float>(i) / 1003.0f) == mpfr_get_flt(value.value, MPFR_RNDN));
      }
    CHECK(acoshf(1.5f) == static_cast<float>(acosh(1.5)));
    CHECK(powf(2.5f, 1.5f) == static_cast<float>(pow(2.5, 1.5)));
    CHECK(atan2f(1.0f, -2.0f) == static_cast<float>(atan2(1.0, -2.0)));
    CHECK(hypotf(3e30f, 4e30f) == 5e30f);
    float s = 0, c = 0;
    sincosf(0.5f, &s, &c);
    CHECK((s == sinf(0.5f) && c == cosf(0.5f)));
  }
}
