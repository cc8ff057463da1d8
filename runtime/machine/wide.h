// Vectors of 32 bytes, which not every processor has. What is done with them ends the same without.
#pragma once

// Of functions that are called where has_wide_vectors alone.
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
