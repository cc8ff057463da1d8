// sin, cos and tan: the argument less the nearest multiple n of pi/2 in a pair (Cody and Waite 1980; Payne and Hanek
// 1983 from 2^20 on), then from the table at t = i/128: sin(t + d) = sin t + (cos t sin d + sin t (cos d - 1)).
#include "graph/math/bits.h"
#include "graph/math/functions.h"
#include "graph/math/tables.h"

namespace jarol::math {
namespace {

constexpr auto table = make_circle_table();

struct Angle {
  Pair r;  // |r| <= pi/4
  int n;   // modulo 4
};

// 2/pi = 0.a2f9..., 64 bits a word, after one word of zeros
constexpr std::uint64_t two_per_pi[]{0,
                                     0xa2f9836e4e441529,
                                     0xfc2757d1f534ddc0,
                                     0xdb6295993c439041,
                                     0xfe5163abdebbc561,
                                     0xb7246e3a424dd2e0,
                                     0x06492eea09d1921c,
                                     0xfe1deb1cb129a73e,
                                     0xe88235f52ebb4484,
                                     0xe99c7026b45f7e41,
                                     0x3991d639835339f4,
                                     0x9c845f8bbdf9283b,
                                     0x1ff897ffde05980f,
                                     0xef2f118b5a0a6d1f,
                                     0x6d367ecf27cb09b7,
                                     0x4f463f669e5fea2d,
                                     0x7527bac7ebe5f17b,
                                     0x3d0739f78a5292ea,
                                     0x6bfb5fb11f8d5d08,
                                     0x56033046fc7b6bab,
                                     0xf0cfbc209af4361d};

__extension__ using Wide = unsigned __int128;

// x 2/pi modulo 4 in units of 2^-190: x = M 2^e times the 192 bits of 2/pi from place e - 2 on; what is before them
// gives multiples of 4, what is after them less than 2^-137
Angle reduce_large(double x) {
  const int e = exponent(x) - 52;
  const std::uint64_t m = (bits(x) & 0xfffffffffffff) | 0x10000000000000;
  const int first = e - 2 + 64, word = first / 64, shift = first % 64;
  std::uint64_t w[3];
  for (int i = 0; i < 3; ++i)
    w[i] = shift == 0 ? two_per_pi[word + i] : two_per_pi[word + i] << shift | two_per_pi[word + i + 1] >> (64 - shift);
  const Wide low = Wide{m} * w[2];
  const Wide middle = Wide{m} * w[1] + static_cast<std::uint64_t>(low >> 64);
  std::uint64_t high = m * w[0] + static_cast<std::uint64_t>(middle >> 64);
  // the fraction nearest to zero: 126 bits of it and 64 more, in two's complement
  int n = static_cast<int>(high >> 62);
  Wide f = (Wide{high} << 64 | static_cast<std::uint64_t>(middle)) << 2 | static_cast<std::uint64_t>(low) >> 62;
  std::uint64_t f_low = static_cast<std::uint64_t>(low) << 2;
  const bool negative = f >> 127 != 0;
  if (negative) {
    n += 1;
    f_low = -f_low;
    f = ~f + (f_low == 0);
  }
  // as three doubles of 64 bits each, weights 2^-64, 2^-128, 2^-192
  const double hi = static_cast<double>(static_cast<std::uint64_t>(f >> 64) >> 11) * 0x1p-53;
  const double mid = static_cast<double>(static_cast<std::uint64_t>(f >> 22) & 0x1fffffffffffff) * 0x1p-106;
  const double low_part =
      static_cast<double>((static_cast<std::uint64_t>(f) & 0x3fffff) << 31 | f_low >> 33) * 0x1p-159;
  Pair r = (sum(hi, mid) + low_part) * half_pi;
  if (negative) r = -r;
  return x < 0.0 ? Angle{-r, -n} : Angle{r, n};
}

inline Angle reduce(double x) {
  const double a = magnitude(x);
  if (a <= 0x1.921fb54442d18p-1) return {{x, 0.0}, 0};
  if (a >= 0x1p20) [[unlikely]]
    return reduce_large(x);
  // pi/2 in four parts, the first three of 33 bits
  constexpr double p1 = 0x1.921fb54400000p+0, p2 = 0x1.0b4611a600000p-34, p3 = 0x1.3198a2e000000p-69,
                   p4 = 0x1.b839a252049c1p-104;
  const Whole n = nearest(x * 0x1.45f306dc9c883p-1);
  const Pair first = sum(x - n.value * p1, -n.value * p2);
  const double rest = n.value * p3;
  const Pair second = sum(first.hi, first.lo - rest);
  if (magnitude(second.hi) > 0x1p-20) return {second, n.number};
  const Pair exact = sum(first.lo, -rest);
  const Pair third = sum(first.hi, exact.hi);
  return {sum(third.hi, third.lo + (exact.lo - n.value * p4)), n.number};
}

// |r| = t + d with its table entry at t, sin d and cos d - 1, |d| <= 1/256
struct Step {
  const CircleEntry& t;
  double sin_d, cos_d;
};

inline Step step(Pair r) {
  const double a = magnitude(r.hi);
  const Whole i = nearest(a * 128.0);
  const double d = a - i.value * (1.0 / 128), d_lo = r.hi < 0.0 ? -r.lo : r.lo, z = d * d;
  return {table[i.number], d + (d_lo + d * z * (-1.0 / 6 + z * (1.0 / 120))),
          z * (-1.0 / 2 + z * (1.0 / 24 - z * (1.0 / 720))) - d * d_lo};
}

// sin r and cos r as sums of a double and what is left, relative error below 2^-57
inline Pair sin_near(Pair r) {
  if (magnitude(r.hi) < 0.13) {
    const double z = r.hi * r.hi;
    const double series =
        z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880 - z * (1.0 / 39916800)))));
    return {r.hi, r.hi * series + (r.lo - 0.5 * z * r.lo)};
  }
  const Step s = step(r);
  const double tail = s.t.cos.hi * s.sin_d + (s.t.sin.lo + s.t.cos.lo * s.sin_d + s.t.sin.hi * s.cos_d);
  return r.hi < 0.0 ? Pair{-s.t.sin.hi, -tail} : Pair{s.t.sin.hi, tail};
}

inline Pair cos_near(Pair r) {
  const Step s = step(r);
  return {s.t.cos.hi, (s.t.cos.lo - s.t.sin.lo * s.sin_d + s.t.cos.hi * s.cos_d) - s.t.sin.hi * s.sin_d};
}

// sin(r + n pi/2)
inline double turned(const Angle& angle) {
  const Pair p = angle.n & 1 ? cos_near(angle.r) : sin_near(angle.r);
  return angle.n & 2 ? -(p.hi + p.lo) : p.hi + p.lo;
}

}  // namespace
}  // namespace jarol::math

using namespace jarol::math;

double sin(double x) noexcept {
  if (magnitude(x) < 0x1p-27) return x;
  if (!(magnitude(x) < infinity)) return x - x;
  return turned(reduce(x));
}

double cos(double x) noexcept {
  if (!(magnitude(x) < infinity)) return x - x;
  Angle angle = reduce(x);
  angle.n += 1;
  return turned(angle);
}

void sincos(double x, double* s, double* c) noexcept {
  if (!(magnitude(x) < infinity)) {
    *s = *c = x - x;
    return;
  }
  Angle angle = reduce(x);
  *s = magnitude(x) < 0x1p-27 ? x : turned(angle);
  angle.n += 1;
  *c = turned(angle);
}

double tan(double x) noexcept {
  if (magnitude(x) < 0x1p-27) return x;
  if (!(magnitude(x) < infinity)) return x - x;
  const Angle angle = reduce(x);
  const Pair s = sin_near(angle.r), c = cos_near(angle.r);
  const Pair sine = fast_sum(s.hi, s.lo), cosine = fast_sum(c.hi, c.lo);
  const Pair q = angle.n & 1 ? -cosine / sine : sine / cosine;
  return q.hi + q.lo;
}
