// Memory that is written soon, and that another core has read or written: its cache lines are fetched meanwhile.
#pragma once

#include <algorithm>
#include <cstddef>

namespace jarol {

/// Of memory that is written from its begin to its end: the two lines that stand 1 KiB after the place `at`.
inline void prefetch_for_write(std::byte* memory, std::size_t size, std::size_t at) {
  for (const std::size_t line : {std::size_t{1024}, std::size_t{1024 + 64}}) {
    std::byte* const soon = memory + std::min(at + line, size - 1);
#if defined(__x86_64__)
    asm volatile("prefetchw %0" : : "m"(*soon));  // the compiler's own asks for lines that can't be written yet
#else
    __builtin_prefetch(soon, 1);
#endif
  }
}

}  // namespace jarol
