// Tables, worked out by the compiler from the series of the functions, in pairs.
#pragma once

#include <array>

#include "graph/math/pair.h"

namespace jarol::math {

// e^x, |x| < 1
constexpr Pair exp_series(Pair x) {
  Pair s{1.0, 0.0};
  for (int n = 28; n > 0; --n) s = x * s / Pair{double(n), 0.0} + 1.0;
  return s;
}

// log(c) = 2 artanh z, z = (c - 1) / (c + 1), c in [0.7, 1.42]
constexpr Pair log_series(double c) {
  const Pair z = Pair{c - 1.0, 0.0} / sum(c, 1.0), square = z * z;
  Pair s{0.0, 0.0};
  for (int n = 47; n > 0; n -= 2) s = square * s + Pair{1.0, 0.0} / Pair{double(n), 0.0};
  return z * s * 2.0;
}

// sin t (first = 1) or cos t (first = 0), |t| < 1
constexpr Pair circle_series(double t, int first) {
  const Pair square = product(t, t);
  Pair s{1.0, 0.0};
  for (int n = 28 + first; n > first; n -= 2) s = -(square * s) / Pair{double(n * (n - 1)), 0.0} + 1.0;
  return first ? s * t : s;
}

// atan d, |d| < 1/100
constexpr Pair atan_series(Pair d) {
  const Pair square = d * d;
  Pair s{0.0, 0.0};
  for (int n = 17; n > 0; n -= 2) s = Pair{1.0, 0.0} / Pair{double(n), 0.0} - square * s;
  return d * s;
}

// 2^(i/128)
constexpr std::array<Pair, 128> make_exp_table() {
  std::array<Pair, 128> table{};
  for (int i = 0; i < 128; ++i) table[i] = exp_series(ln_2 * (i / 128.0));
  return table;
}

// for m near i/128: its inverse in 10 bits, and -log of that, hi a multiple of 2^-42
struct LogEntry {
  double inverse, hi, lo;
};
constexpr int log_first = 90, log_last = 182;
constexpr std::array<LogEntry, log_last - log_first + 1> make_log_table() {
  std::array<LogEntry, log_last - log_first + 1> table{};
  for (int i = log_first; i <= log_last; ++i) {
    const double inverse = static_cast<int>(512.0 * 128.0 / i + 0.5) / 512.0;
    const Pair log = -log_series(inverse);
    const double hi = (log.hi + 0x1.8p10) - 0x1.8p10;
    table[i - log_first] = {inverse, hi, (log.hi - hi) + log.lo};
  }
  return table;
}

// sin and cos of i/128, up to pi/4
struct CircleEntry {
  Pair sin, cos;
};
constexpr std::array<CircleEntry, 102> make_circle_table() {
  std::array<CircleEntry, 102> table{};
  for (int i = 0; i < 102; ++i) table[i] = {circle_series(i / 128.0, 1), circle_series(i / 128.0, 0)};
  return table;
}

// atan of i/128: from one to the next by the atan of (t - s) / (1 + t s)
constexpr std::array<Pair, 129> make_atan_table() {
  std::array<Pair, 129> table{};
  for (int i = 1; i < 129; ++i)
    table[i] = table[i - 1] + atan_series(Pair{1.0 / 128.0, 0.0} / Pair{1.0 + i * (i - 1) / 16384.0, 0.0});
  return table;
}

}  // namespace jarol::math
