// Options of a compiler that change layouts or arithmetic, as the file that includes this is compiled with.
#pragma once

#include <cstdint>
#include <string>

#if defined(__has_feature)
#define JAROL_HAS(feature) __has_feature(feature)
#else
#define JAROL_HAS(feature) 0
#endif

namespace jarol {

/// Members of four bytes alone: none of these options changes where they lie.
struct BuildOptions {
  std::int32_t cxx11_strings = 0, debug_containers = 0, packed_structs = 0, short_enums = 0;
  std::int32_t fast_math = 0, x87_math = 0, address_sanitizer = 0, thread_sanitizer = 0;
  std::int32_t long_double = 0, wide_char = 0, largest_vector = 0;  // bytes
};

namespace detail {
struct Packed {
  char first;
  double second;
};
enum Short { only };
}  // namespace detail

/// Internal to the file, as each is compiled with options of its own.
namespace {
[[maybe_unused]] constexpr BuildOptions options_of_this_file() {
  BuildOptions options;
#if defined(_GLIBCXX_USE_CXX11_ABI)
  options.cxx11_strings = _GLIBCXX_USE_CXX11_ABI;
#endif
#if defined(_GLIBCXX_DEBUG)
  options.debug_containers = 1;
#endif
#if defined(__FAST_MATH__) || __FINITE_MATH_ONLY__ || (defined(__GCC_IEC_559) && __GCC_IEC_559 == 0)
  options.fast_math = 1;
#endif
#if defined(__SANITIZE_ADDRESS__) || JAROL_HAS(address_sanitizer)
  options.address_sanitizer = 1;
#endif
#if defined(__SANITIZE_THREAD__) || JAROL_HAS(thread_sanitizer)
  options.thread_sanitizer = 1;
#endif
  options.x87_math = __FLT_EVAL_METHOD__ != 0;
  options.packed_structs = sizeof(detail::Packed) != 2 * sizeof(double);
  options.short_enums = sizeof(detail::Short) != sizeof(int);
  options.long_double = sizeof(long double);
  options.wide_char = sizeof(wchar_t);
  options.largest_vector = __BIGGEST_ALIGNMENT__;
  return options;
}
}  // namespace
#undef JAROL_HAS

/// Which of the switches differs, as in "with -D_GLIBCXX_DEBUG"; empty: none.
std::string find_other_switch(const BuildOptions& options, const BuildOptions& expected);

/// Why a program that is compiled with these options can't call a library that is compiled with the other ones; empty:
/// it can. Sanitizers may look on at the program alone.
std::string find_difference(BuildOptions program, const BuildOptions& library);

}  // namespace jarol
