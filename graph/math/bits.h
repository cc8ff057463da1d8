// Doubles as bits, powers of two, and rounding to whole numbers by addition: what needs no other function.
#pragma once

#include <bit>
#include <cstdint>

#include "graph/math/pair.h"

namespace jarol::math {

inline std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }
inline double from_bits(std::uint64_t b) { return std::bit_cast<double>(b); }
inline bool is_nan(double x) { return x != x; }
inline double magnitude(double x) { return __builtin_fabs(x); }
inline double with_sign(double x, double sign) { return __builtin_copysign(x, sign); }

constexpr double infinity = __builtin_inf();

// the exponent of a normal x: |x| in [2^e, 2^(e+1))
inline int exponent(double x) { return static_cast<int>(bits(x) >> 52 & 0x7ff) - 1023; }

// 2^k, -1022 <= k <= 1023
inline double power_of_two(int k) { return from_bits(static_cast<std::uint64_t>(k + 1023) << 52); }

// the whole number next to x, |x| < 2^31
struct Whole {
  double value;
  int number;
};
inline Whole nearest(double x) {
  constexpr double shift = 0x1.8p52;
  const double shifted = x + shift;
  return {shifted - shift, static_cast<int>(static_cast<std::uint32_t>(bits(shifted)))};
}

// m 2^k, rounded once, for m.hi in [0.99, 2.01]
inline double scaled(Pair m, int k) {
  const Pair exact = fast_sum(m.hi, m.lo);
  const double value = exact.hi;
  if (k >= -1021) [[likely]]
    return k < 1023 ? value * power_of_two(k) : value * 0x1p1022 * power_of_two(k < 2045 ? k - 1022 : 1023);
  if (k < -1080) return 0x1p-1000 * 0x1p-1000;
  // in units of the least double: where it is below 2^52, a whole number of them, by the addition of 2^52
  const double unit = power_of_two(k + 1074), units = value * unit;
  if (units >= 0x1p52) return value * power_of_two(k + 1000) * 0x1p-1000;
  const Pair s = fast_sum(0x1p52, units);
  return ((s.hi + (s.lo + exact.lo * unit)) - 0x1p52) * 0x1p-1000 * 0x1p-74;
}

}  // namespace jarol::math
