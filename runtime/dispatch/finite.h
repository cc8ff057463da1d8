// Whether many numbers are finite, at the price of reading them.
#pragma once

#include <cmath>
#include <cstddef>

namespace jarol {

/// False if any is an infinity or a NaN, which no sum loses; or if the sum grows too great, which is rare and asks for
/// a closer look. `first` and `last` are at begins of cache lines.
inline bool are_surely_finite(const double* first, const double* last) {
  typedef double Pair __attribute__((vector_size(16), may_alias));
  constexpr std::ptrdiff_t line = 4;  // in pairs
  const Pair* next = reinterpret_cast<const Pair*>(first);
  const Pair* const end = reinterpret_cast<const Pair*>(last);
  // sums side by side: one alone would wait for each addition
  Pair sum[2 * line] = {};
  if ((end - next) % (2 * line) != 0) {
    for (std::ptrdiff_t i = 0; i < line; ++i) sum[i] = next[i];
    next += line;
  }
  for (; next != end; next += 2 * line)
    for (std::ptrdiff_t i = 0; i < 2 * line; ++i) sum[i] += next[i];
  const Pair all = ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
  return std::isfinite(all[0] + all[1]);
}

}  // namespace jarol
