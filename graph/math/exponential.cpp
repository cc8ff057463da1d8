#include "graph/math/exponential.h"

#include "graph/math/functions.h"
#include "graph/math/tables.h"

namespace jarol::math {
namespace {

constexpr std::array<Pair, 128> table = make_exp_table();

// ln 2 / 128, the first of 34 bits
constexpr double step_1 = 0x1.62e42fef80000p-8, step_2 = 0x1.1cf79abc9e3b4p-43;
constexpr double per_step = 0x1.71547652b82fep+7;

// beyond these e^x is no double, or less than half of the least
constexpr double highest = 0x1.62e42fefa39efp+9, lowest = -0x1.74910d52d3052p+9;

inline double overflow() { return 0x1p1000 * 0x1p1000; }
inline double underflow() { return 0x1p-1000 * 0x1p-1000; }

// e^r - 1 - r, |r| < ln 2 / 256
inline double rest(double r) {
  return r * r * (1.0 / 2 + r * (1.0 / 6 + r * (1.0 / 24 + r * (1.0 / 120 + r * (1.0 / 720)))));
}

}  // namespace

Scaled exp_pair(Pair x) {
  const Whole n = nearest(x.hi * per_step);
  const Pair r = fast_sum(x.hi - n.value * step_1, x.lo - n.value * step_2);
  const Pair e = fast_sum(r.hi, r.lo + rest(r.hi));
  const Pair t = table[n.number & 127];
  const Pair p = t * e;
  const Pair m = fast_sum(t.hi, p.hi);
  return {fast_sum(m.hi, m.lo + (t.lo + p.lo)), n.number >> 7};
}

namespace {

// the table's part times e^r, where n steps are left out
inline Pair times_rest(Pair x, double n, double hi, double lo) {
  const double r = (x.hi - n * step_1) + (x.lo - n * step_2);
  return {hi, lo + hi * (r + rest(r))};
}

}  // namespace

double exp_rounded(Pair x) {
  const Whole n = nearest(x.hi * per_step);
  const Pair t = table[n.number & 127];
  return scaled(times_rest(x, n.value, t.hi, t.lo), n.number >> 7);
}

void exp_rounded(const Pairs& x, double (&result)[4]) {
  double n[4], hi[4], lo[4], power[4];
  for (int i = 0; i < 4; ++i) {
    const Whole whole = nearest(x.hi[i] * per_step);
    const Pair t = table[whole.number & 127];
    n[i] = whole.value;
    hi[i] = t.hi;
    lo[i] = t.lo;
    power[i] = power_of_two(whole.number >> 7);
  }
  for (int i = 0; i < 4; ++i) {
    const Pair m = times_rest({x.hi[i], x.lo[i]}, n[i], hi[i], lo[i]);
    result[i] = (m.hi + m.lo) * power[i];
  }
}

namespace {

// what a power b^x gives for x too large or too small, or NaN
inline double beyond(double x) {
  if (is_nan(x)) return x + x;
  if (x == infinity) return x;
  if (x == -infinity) return 0.0;
  return x > 0.0 ? overflow() : underflow();
}

}  // namespace
}  // namespace jarol::math

using namespace jarol::math;

double exp(double x) noexcept {
  if (!(x <= highest && x >= lowest)) return beyond(x);
  return exp_rounded({x, 0.0});
}

double exp2(double x) noexcept {
  if (!(x < 1024.0 && x > -1075.5)) return beyond(x);
  return exp_rounded(ln_2 * x);
}

double exp10(double x) noexcept {
  if (!(x < 309.0 && x > -325.0)) return beyond(x);
  if (magnitude(x) < 0x1p-60) return 1.0 + x;
  return exp_rounded(ln_10 * x);
}

double expm1(double x) noexcept {
  const double a = magnitude(x);
  if (a < 0x1p-8) {
    if (a < 0x1p-54) return x;
    return x + x * x * (1.0 / 2 + x * (1.0 / 6 + x * (1.0 / 24 + x * (1.0 / 120 + x * (1.0 / 720)))));
  }
  if (!(x <= highest)) return beyond(x);
  if (x < -40.0) return -1.0 + 0x1p-60;
  const Scaled e = exp_pair({x, 0.0});
  if (e.k > 110) return e.rounded();
  const Pair less = e.m + -power_of_two(-e.k);
  return (less.hi + less.lo) * power_of_two(e.k);
}

double sinh(double x) noexcept {
  const double a = magnitude(x);
  if (a < 0x1p-4) {
    if (a < 0x1p-28) return x;
    const double z = x * x;
    return x + x * z * (1.0 / 6 + z * (1.0 / 120 + z * (1.0 / 5040 + z * (1.0 / 362880))));
  }
  if (!(a < 711.0)) return is_nan(x) ? x + x : x * 0x1p1000 * 0x1p1000;
  Scaled e = exp_pair({a, 0.0});
  if (a < 40.0) e.m = e.m - Pair{power_of_two(-2 * e.k), 0.0} / e.m;
  return with_sign(scaled(e.m, e.k - 1), x);
}

double cosh(double x) noexcept {
  const double a = magnitude(x);
  if (!(a < 711.0)) return is_nan(x) ? x + x : a * 0x1p1000 * 0x1p1000;
  Scaled e = exp_pair({a, 0.0});
  if (a < 40.0) e.m = e.m + Pair{power_of_two(-2 * e.k), 0.0} / e.m;
  return scaled(e.m, e.k - 1);
}

double tanh(double x) noexcept {
  const double a = magnitude(x);
  if (a < 0x1p-4) {
    if (a < 0x1p-28) return x;
    const double z = x * x;
    return x + x * z *
                   (-1.0 / 3 + z * (2.0 / 15 + z * (-17.0 / 315 + z * (62.0 / 2835 + z * (-1382.0 / 155925 +
                                                                                          z * (21844.0 / 6081075))))));
  }
  if (is_nan(x)) return x + x;
  if (a > 22.0) return with_sign(1.0 - 0x1p-60, x);
  const Scaled e = exp_pair({2.0 * a, 0.0});
  const double one = power_of_two(-e.k);
  const Pair q = (e.m + -one) / (e.m + one);
  return with_sign(q.hi + q.lo, x);
}
