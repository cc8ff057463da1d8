// Whether many numbers are finite, at the price of reading them.
#pragma once

#include <cmath>
#include <cstddef>

namespace jarol {

/// False if any is an infinity or a NaN, which no sum loses; or if the sum grows too great, which is rare and asks for
/// a closer look. `first` and `last` are at begins of cache lines.
inline bool are_surely_finite(const double* first, const double* last) {
  // sums side by side: one alone would wait for each addition
  constexpr std::ptrdiff_t step = 16;
  double sums[step] = {};
  if ((last - first) % step != 0) {
    for (std::ptrdiff_t i = 0; i < step / 2; ++i) sums[i] = first[i];
    first += step / 2;
  }
  for (; first != last; first += step)
    for (std::ptrdiff_t i = 0; i < step; ++i) sums[i] += first[i];
  double sum = 0;
  for (const double s : sums) sum += s;
  return std::isfinite(sum);
}

}  // namespace jarol
