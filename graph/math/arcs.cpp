// atan and what follows from it: for a quotient near t = i/128, atan(y/x) = atan t + atan((y - t x) / (x + t y)), in
// pairs.
#include "graph/math/bits.h"
#include "graph/math/functions.h"
#include "graph/math/tables.h"

namespace jarol::math {
namespace {

constexpr auto table = make_atan_table();

// a - b without cancellation
inline Pair less(Pair a, Pair b) {
  const Pair s = fast_sum(a.hi, -b.hi);
  return {s.hi, s.lo + (a.lo - b.lo)};
}

// atan(y/x), 0 <= y <= x, x not too far from 1 and y/x not below 2^-70 or 0
inline Pair atan_near(Pair y, Pair x) {
  const Whole i = nearest(y.hi / x.hi * 128.0);
  const double t = i.value * (1.0 / 128);
  // t has 8 bits: times the upper bits of x it is exact, and so is what that leaves of y
  const double upper = from_bits(bits(x.hi) & ~0xffull), lower = x.hi - upper;
  const Pair n = sum(y.hi - t * upper, (y.lo - t * x.lo) - t * lower);
  Pair d = fast_sum(x.hi, t * y.hi);
  d.lo += x.lo + t * y.lo;
  const double q = n.hi / d.hi;
  const Pair p = product(q, d.hi);
  const double q_lo = ((n.hi - p.hi) - p.lo + (n.lo - q * d.lo)) / d.hi;
  const double z = q * q;
  const double cubic = q * z * (-1.0 / 3 + z * (1.0 / 5 - z * (1.0 / 7)));
  const Pair angle = fast_sum(table[i.number].hi, q);
  return fast_sum(angle.hi, angle.lo + (table[i.number].lo + q_lo + cubic));
}

// the angle of (x, y) from the x axis, 0..pi, for y >= 0
inline double angle_of(Pair x, Pair y) {
  const bool back = x.hi < 0.0;
  if (back) x = -x;
  Pair a = y.hi > x.hi ? less(half_pi, atan_near(x, y)) : atan_near(y, x);
  if (back) a = less(pi, a);
  return a.hi + a.lo;
}

// 1 - x^2
inline Pair complement(double x) { return sum(1.0, -x) * sum(1.0, x); }

}  // namespace
}  // namespace jarol::math

using namespace jarol::math;

double atan(double x) noexcept {
  const double a = magnitude(x);
  if (a < 0x1p-27) return x;
  if (is_nan(x)) return x + x;
  if (a > 0x1p60) return with_sign(half_pi.hi, x);
  return with_sign(angle_of({1.0, 0.0}, {a, 0.0}), x);
}

double atan2(double y, double x) noexcept {
  if (is_nan(x) || is_nan(y)) return x + y;
  double a = magnitude(y), b = magnitude(x);
  const bool back = bits(x) >> 63 != 0;
  if (a == 0.0) return with_sign(back ? pi.hi : 0.0, y);
  if (b == 0.0) return with_sign(half_pi.hi, y);
  if (a == infinity || b == infinity) {
    if (a != b) return with_sign(a == infinity ? half_pi.hi : back ? pi.hi : 0.0, y);
    return with_sign(back ? 0x1.2d97c7f3321d2p+1 : 0.5 * half_pi.hi, y);
  }
  // far apart: one of the axes, or the quotient
  if (a < 0x1p-1022) {
    a *= 0x1p60;
    b = b < 0x1p900 ? b * 0x1p60 : infinity;
  } else if (b < 0x1p-1022) {
    b *= 0x1p60;
    a = a < 0x1p900 ? a * 0x1p60 : infinity;
  }
  const int apart = (a == infinity ? 2000 : exponent(a)) - (b == infinity ? 2000 : exponent(b));
  if (apart > 62) return with_sign(half_pi.hi, y);
  if (apart < -62) return back ? with_sign(pi.hi, y) : with_sign(magnitude(y) / magnitude(x), y);
  // both near 1
  const int e = exponent(a > b ? a : b);
  const double down = power_of_two(-e / 2), rest = power_of_two(-e - (-e / 2));
  a = a * down * rest;
  b = b * down * rest;
  return with_sign(angle_of({back ? -b : b, 0.0}, {a, 0.0}), y);
}

double asin(double x) noexcept {
  const double a = magnitude(x);
  if (!(a <= 1.0)) return (x - x) / (x - x);
  if (a == 1.0) return with_sign(half_pi.hi, x);
  if (a < 0x1p-27) return x;
  return with_sign(angle_of(root(complement(x)), {a, 0.0}), x);
}

double acos(double x) noexcept {
  if (!(magnitude(x) <= 1.0)) return (x - x) / (x - x);
  if (x == 1.0) return 0.0;
  if (x == -1.0) return pi.hi;
  if (magnitude(x) < 0x1p-60) return half_pi.hi;
  return angle_of({x, 0.0}, root(complement(x)));
}
