// Powers and roots: x^y = e^(y log x) in pairs, error below 0.53 ulp.
#include "graph/math/exponential.h"
#include "graph/math/functions.h"
#include "graph/math/logarithm.h"
#include "graph/math/powers.h"

namespace jarol::math {
namespace {

inline bool is_whole(double y) {
  const double a = magnitude(y);
  return a >= 0x1p52 || (a + 0x1p52) - 0x1p52 == a;
}

inline bool is_odd(double y) { return magnitude(y) < 0x1p53 && is_whole(y) && !is_whole(0.5 * y); }

// x^y where x or y is zero, infinite or NaN
double power_at_edge(double x, double y) {
  if (is_nan(x) || is_nan(y)) return x + y;
  if (magnitude(y) == infinity) {
    const double a = magnitude(x);
    if (a == 1.0) return 1.0;
    return (a > 1.0) == (y > 0.0) ? infinity : 0.0;
  }
  double result = magnitude(x);
  if (y < 0.0) result = 1.0 / result;
  return is_odd(y) ? with_sign(result == 0.0 ? 0.0 : infinity, x) : (result == 0.0 ? 0.0 : infinity);
}

// for finite x > 0 and finite y != 0
inline double power(double x, double y, double sign) {
  const double size = magnitude(y);
  if (size < 0x1p-70) return sign * (1.0 + (x > 1.0 ? y : -y));
  const Pair l = log_pair(x);
  const double estimate = y * l.hi;
  if (!(magnitude(estimate) < 750.0)) return (estimate > 0.0 ? 0x1p1000 * 0x1p1000 : 0x1p-1000 * 0x1p-1000) * sign;
  // y may be too large to be halved into bits only where log x is small: as y 2^-100 and l 2^100
  const Pair z = size < 0x1p900 ? l * y : Pair{l.hi * 0x1p100, l.lo * 0x1p100} * (y * 0x1p-100);
  return exp_rounded(z) * sign;
}

}  // namespace

std::array<double, 4> pow_each(const std::array<double, 4>& x, double y) {
  const double size = magnitude(y);
  double a[4], result[4];
  bool is_ordinary = size >= 0x1p-70 && size < 0x1p900 && y != 2.0;
  for (int i = 0; i < 4; ++i) {
    a[i] = x[static_cast<std::size_t>(i)];
    is_ordinary &= a[i] >= 0x1p-1022 && a[i] < infinity && a[i] != 1.0;
  }
  if (is_ordinary) [[likely]] {
    Pairs l;
    log_pairs(a, l);
    bool is_small = true;
    for (int i = 0; i < 4; ++i) is_small &= magnitude(y * l.hi[i]) < 700.0;
    for (int i = 0; i < 4; ++i) {
      const Pair z = Pair{l.hi[i], l.lo[i]} * y;
      l.hi[i] = z.hi;
      l.lo[i] = z.lo;
    }
    if (is_small) [[likely]] {
      exp_rounded(l, result);
      return {result[0], result[1], result[2], result[3]};
    }
  }
  return {pow(x[0], y), pow(x[1], y), pow(x[2], y), pow(x[3], y)};
}

}  // namespace jarol::math

using namespace jarol::math;

double pow(double x, double y) noexcept {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (y == 2.0) return x * x;
  if (!(x > 0.0 && x < infinity && magnitude(y) < infinity)) [[unlikely]] {
    if (x == 0.0 || !(magnitude(x) < infinity && magnitude(y) < infinity)) return power_at_edge(x, y);
    if (!is_whole(y)) return (x - x) / 0.0;
    return power(-x, y, is_odd(y) ? -1.0 : 1.0);
  }
  return power(x, y, 1.0);
}

double cbrt(double x) noexcept {
  double a = magnitude(x);
  if (a == 0.0 || !(a < infinity)) return x + x;
  int k = 0;
  if (a < 0x1p-1022) {
    a *= 0x1p54;
    k = -54;
  }
  // a = m 2^(3 e), m in [1, 8)
  int e = exponent(a) + 1074;
  k += e - e % 3 - 1074;
  e = e % 3;
  const double m = from_bits((bits(a) & 0xfffffffffffff) | static_cast<std::uint64_t>(1023 + e) << 52);
  // Newton's rule from a straight line, the last step with what is left of m in full
  double y = 0.8 + 0.16 * m;
  for (int i = 0; i < 5; ++i) y = y - (y - m / (y * y)) * (1.0 / 3);
  const Pair cube = product(y, y) * y;
  y += ((m - cube.hi) - cube.lo) / (3.0 * y * y);
  return with_sign(y * power_of_two(k / 3), x);
}

double hypot(double x, double y) noexcept {
  double a = magnitude(x), b = magnitude(y);
  if (!(a < infinity && b < infinity)) return a == infinity || b == infinity ? infinity : x + y;
  if (a < b) {
    const double swap = a;
    a = b;
    b = swap;
  }
  if (b <= a * 0x1p-60) return a + b;
  double scale = 1.0;
  if (a > 0x1p480) {
    scale = 0x1p600;
    a *= 0x1p-600;
    b *= 0x1p-600;
  } else if (b < 0x1p-450) {
    scale = 0x1p-600;
    a *= 0x1p600;
    b *= 0x1p600;
  }
  const Pair p = product(a, a), q = product(b, b);
  const Pair s = fast_sum(p.hi, q.hi);
  const double root = __builtin_sqrt(s.hi);
  const Pair r = product(root, root);
  return (root + ((s.hi - r.hi) + (s.lo + p.lo + q.lo - r.lo)) / (2.0 * root)) * scale;
}
