// Copies of what a task has just stored, often as words of 8: a load over two stores would wait until both are in the
// cache, so each word is loaded by itself.
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <cstddef>
#include <cstring>

namespace jarol {

/// So many bytes, a multiple of 16. Where nobody waits for the copy, memcpy costs less.
template <std::size_t Bytes>
[[gnu::always_inline]] inline void copy_fresh(void* to, const void* from) {
  static_assert(Bytes % 16 == 0);
#ifdef __SSE2__
  auto* const target = static_cast<std::byte*>(to);
  const auto* const source = static_cast<const std::byte*>(from);
  for (std::size_t at = 0; at < Bytes; at += 16) {
    double low, high;
    std::memcpy(&low, source + at, sizeof low);
    std::memcpy(&high, source + at + sizeof low, sizeof high);
    asm("" : "+x"(low));  // or the compiler makes one load of both
    const __m128d two = _mm_set_pd(high, low);
    std::memcpy(target + at, &two, sizeof two);
  }
#else
  std::memcpy(to, from, Bytes);
#endif
}

}  // namespace jarol
