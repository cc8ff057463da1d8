// Vectors of 32 bytes, which not every processor has. Results are the same without them.
#pragma once

// Of functions that are called only if has_wide_vectors.
#if defined(__x86_64__)
#define JAROL_WIDE [[gnu::target("avx2")]]
#else
#define JAROL_WIDE
#endif

namespace jarol {

#if defined(__x86_64__)
inline const bool has_wide_vectors = __builtin_cpu_supports("avx2") != 0;
#else
inline const bool has_wide_vectors = false;
#endif

}  // namespace jarol
