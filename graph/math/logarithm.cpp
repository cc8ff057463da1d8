#include "graph/math/logarithm.h"

#include "graph/math/functions.h"
#include "graph/math/tables.h"

namespace jarol::math {
namespace {

constexpr auto table = make_log_table();

// ln 2, the first a multiple of 2^-42
constexpr double ln_2_hi = (ln_2.hi + 0x1.8p10) - 0x1.8p10, ln_2_lo = (ln_2.hi - ln_2_hi) + ln_2.lo;

// log x = hi + lo + log(1 + r); hi is 0 or larger than r
struct Reduced {
  double hi, lo;
  Pair r;
};

// x = 2^k m, m in [1/sqrt 2, sqrt 2]
struct Split {
  double m;
  int k;
};

// normal x
inline Split split(double x) {
  const std::uint64_t b = bits(x);
  const double m = from_bits((b & 0xfffffffffffff) | 0x3ff0000000000000);
  const bool high = (b & 0xfffffffffffff) > 0x6a09e667f3bcc;
  return {high ? 0.5 * m : m, static_cast<int>(b >> 52) - 1023 + high};
}

inline const LogEntry& entry_of(double m) { return table[nearest(m * 128.0).number - log_first]; }

inline Reduced reduce(double m, double upper, double k, double inverse, double hi, double lo) {
  const double lower = m - upper;
  return {k * ln_2_hi + hi, k * ln_2_lo + lo, fast_sum(upper * inverse - 1.0, lower * inverse)};
}

inline double upper_of(double m) { return from_bits(bits(m) & ~0x7ffull); }

inline Reduced reduce(double x) {
  const bool is_small = x < 0x1p-1022;
  const Split s = split(is_small ? x * 0x1p54 : x);
  const LogEntry& entry = entry_of(s.m);
  return reduce(s.m, upper_of(s.m), is_small ? s.k - 54 : s.k, entry.inverse, entry.hi, entry.lo);
}

// (log(1 + r) - r + r^2/2) / r^3, |r| < 2^-7
inline double rest(double r) {
  return 1.0 / 3 + r * (-1.0 / 4 + r * (1.0 / 5 + r * (-1.0 / 6 + r * (1.0 / 7 + r * (-1.0 / 8 + r * (1.0 / 9))))));
}

inline Pair log_of(const Reduced& a) {
  const double r = a.r.hi;
  const Pair first = fast_sum(a.hi, r);
  // r^2/2: the upper half of r squared is exact
  const Pair half = halves(r);
  const double square = -0.5 * half.hi * half.hi, square_lo = -0.5 * half.lo * (r + half.hi);
  const double tail = (a.r.lo + a.lo) + (square_lo - r * a.r.lo) + r * r * r * rest(r);
  const Pair second = fast_sum(first.hi, square);
  return fast_sum(second.hi, second.lo + (first.lo + tail));
}

// what logarithms give for x <= 0, infinity and NaN
inline double beyond(double x) {
  if (x == 0.0) return -1.0 / (x * x);
  if (x < 0.0) return (x - x) / 0.0;
  return x + x;
}

inline bool ordinary(double x) { return x > 0.0 && x < infinity; }

}  // namespace

Pair log_pair(double x) { return log_of(reduce(x)); }

void log_pairs(const double (&x)[4], Pairs& result) {
  double m[4], upper[4], k[4], inverse[4], hi[4], lo[4];
  for (int i = 0; i < 4; ++i) {
    const Split s = split(x[i]);
    const LogEntry& entry = entry_of(s.m);
    m[i] = s.m;
    upper[i] = upper_of(s.m);
    k[i] = s.k;
    inverse[i] = entry.inverse;
    hi[i] = entry.hi;
    lo[i] = entry.lo;
  }
  for (int i = 0; i < 4; ++i) {
    const Pair l = log_of(reduce(m[i], upper[i], k[i], inverse[i], hi[i], lo[i]));
    result.hi[i] = l.hi;
    result.lo[i] = l.lo;
  }
}

Pair log_pair(Pair x) {
  const double l = x.lo / x.hi;
  return log_pair(x.hi) + Pair{l, -0.5 * l * l};
}

}  // namespace jarol::math

using namespace jarol::math;

double log(double x) noexcept {
  if (!ordinary(x)) return beyond(x);
  const Reduced a = reduce(x);
  const double r = a.r.hi;
  const Pair first = fast_sum(a.hi, r);
  return first.hi + (first.lo + (a.r.lo + a.lo + r * r * (-0.5 + r * rest(r))));
}

double log2(double x) noexcept {
  if (!ordinary(x)) return beyond(x);
  const Pair l = log_pair(x) * per_ln_2;
  return l.hi + l.lo;
}

double log10(double x) noexcept {
  if (!ordinary(x)) return beyond(x);
  const Pair l = log_pair(x) * per_ln_10;
  return l.hi + l.lo;
}

double log1p(double x) noexcept {
  const double a = magnitude(x);
  if (a < 0x1p-8) {
    if (a < 0x1p-54) return x;
    return x + x * x * (-0.5 + x * rest(x));
  }
  if (x == -1.0) return -1.0 / 0.0;
  if (!(x > -1.0 && x < infinity)) return beyond(x);
  const Pair l = log_pair(sum(1.0, x));
  return l.hi + l.lo;
}

double asinh(double x) noexcept {
  const double a = magnitude(x);
  if (a < 0x1p-5) {
    if (a < 0x1p-28) return x;
    const double z = x * x;
    return x + x * z * (-1.0 / 6 + z * (3.0 / 40 + z * (-15.0 / 336 + z * (105.0 / 3456 - z * (945.0 / 42240)))));
  }
  if (!(a < infinity)) return x + x;
  const Pair l = a > 0x1p30 ? log_pair(a) + ln_2 : log_pair(root(product(a, a) + 1.0) + a);
  return with_sign(l.hi + l.lo, x);
}

double acosh(double x) noexcept {
  if (!(x >= 1.0 && x < infinity)) return x < 1.0 ? (x - x) / 0.0 : x + x;
  if (x == 1.0) return 0.0;
  if (x > 0x1p30) {
    const Pair l = log_pair(x) + ln_2;
    return l.hi + l.lo;
  }
  // log(1 + s), s = t + sqrt(t (t + 2)), t = x - 1
  const Pair t = sum(x, -1.0);
  const Pair l = log_pair((root(t * (t + 2.0)) + t) + 1.0);
  return l.hi + l.lo;
}

double atanh(double x) noexcept {
  const double a = magnitude(x);
  if (a < 0x1p-5) {
    if (a < 0x1p-28) return x;
    const double z = x * x;
    return x + x * z * (1.0 / 3 + z * (1.0 / 5 + z * (1.0 / 7 + z * (1.0 / 9 + z * (1.0 / 11)))));
  }
  if (!(a < 1.0)) return a == 1.0 ? x / 0.0 : (x - x) / (x - x);
  const Pair l = log_pair(sum(1.0, a) / sum(1.0, -a));
  return with_sign(0.5 * (l.hi + l.lo), x);
}
