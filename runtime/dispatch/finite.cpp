#include "runtime/dispatch/finite.h"

#include <cmath>
#include <cstddef>

namespace jarol {
namespace {

// With vectors of so many bytes.
template <std::size_t Bytes>
[[gnu::always_inline]] inline bool is_sum_finite(const double* first, const double* last) {
  typedef double Vector __attribute__((vector_size(Bytes), may_alias));
  constexpr std::ptrdiff_t line = 64 / Bytes;  // in vectors
  const Vector* next = reinterpret_cast<const Vector*>(first);
  const Vector* const end = reinterpret_cast<const Vector*>(last);
  // sums side by side: one alone would wait for each addition
  Vector sum[2 * line] = {};
  if ((end - next) % (2 * line) != 0) {
    for (std::ptrdiff_t i = 0; i < line; ++i) sum[i] = next[i];
    next += line;
  }
  for (; next != end; next += 2 * line)
    for (std::ptrdiff_t i = 0; i < 2 * line; ++i) sum[i] += next[i];
  for (std::ptrdiff_t half = line; half > 0; half /= 2)
    for (std::ptrdiff_t i = 0; i < half; ++i) sum[i] += sum[i + half];
  double all = 0;
  for (std::size_t i = 0; i < Bytes / sizeof all; ++i) all += sum[0][i];
  return std::isfinite(all);
}

JAROL_WIDE bool is_sum_finite_wide(const double* first, const double* last) { return is_sum_finite<32>(first, last); }

}  // namespace

bool are_surely_finite(const double* first, const double* last, bool wide) {
  return wide ? is_sum_finite_wide(first, last) : is_sum_finite<16>(first, last);
}

}  // namespace jarol
