// How code was compiled, as far as a plugin and the program that loads it have to agree: layout and arithmetic. Plain
// numbers that lie in the library's file and are read there, before anything of it runs.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "graph/registry.h"

#if defined(__has_feature)
#define JAROL_HAS(feature) __has_feature(feature)
#else
#define JAROL_HAS(feature) 0
#endif

namespace jarol {

/// Members of four bytes and bytes alone: no option of a compiler changes where they lie.
struct PluginBuild {
  char magic[16] = {'j', 'a', 'r', 'o', 'l', ' ', 'p', 'l', 'u', 'g', 'i', 'n', ' ', 'o', 'f', ':'};
  std::int32_t form = 10;  // grows with every change of this interface
  std::int32_t cxx11_strings = 0, debug_containers = 0, packed_structs = 0, short_enums = 0;
  std::int32_t fast_math = 0, x87_math = 0, address_sanitizer = 0, thread_sanitizer = 0;
  std::int32_t long_double = 0, wide_char = 0, eigen_alignment = 0;               // bytes
  std::int32_t task_class = 0, type = 0, sequence = 0, string = 0, registry = 0;  // bytes
  char compiler[64] = {};
};

namespace detail {
struct Packed {
  char first;
  double second;
};
enum Short { only };
}  // namespace detail

/// Of the file that includes this; internal to it, as each is compiled with options of its own.
namespace {
consteval PluginBuild build_of_this_file() {
  PluginBuild build;
#if defined(_GLIBCXX_USE_CXX11_ABI)
  build.cxx11_strings = _GLIBCXX_USE_CXX11_ABI;
#endif
#if defined(_GLIBCXX_DEBUG)
  build.debug_containers = 1;
#endif
#if defined(__FAST_MATH__) || __FINITE_MATH_ONLY__ || (defined(__GCC_IEC_559) && __GCC_IEC_559 == 0)
  build.fast_math = 1;
#endif
#if defined(__SANITIZE_ADDRESS__) || JAROL_HAS(address_sanitizer)
  build.address_sanitizer = 1;
#endif
#if defined(__SANITIZE_THREAD__) || JAROL_HAS(thread_sanitizer)
  build.thread_sanitizer = 1;
#endif
  build.x87_math = __FLT_EVAL_METHOD__ != 0;
  build.packed_structs = sizeof(detail::Packed) != 2 * sizeof(double);
  build.short_enums = sizeof(detail::Short) != sizeof(int);
  build.long_double = sizeof(long double);
  build.wide_char = sizeof(wchar_t);
  build.eigen_alignment = alignof(Eigen::Vector4d);
  build.task_class = sizeof(TaskClass);
  build.type = sizeof(Type);
  build.sequence = sizeof(Sequence<double>);
  build.string = sizeof(String);
  build.registry = sizeof(Registry);
  constexpr char compiler[] =
#if defined(__clang__)
      __VERSION__;
#else
      "g++ " __VERSION__;
#endif
  for (std::size_t i = 0; i < sizeof compiler && i + 1 < sizeof build.compiler; ++i) build.compiler[i] = compiler[i];
  return build;
}

/// A product and a sum, each rounded? A compiler that may use FMA instructions makes one rounding of them unless told.
[[gnu::noinline, maybe_unused]] bool rounds_products(const volatile double& a, const volatile double& b) {
  const double x = a, y = b;
  return x * x - y == 0;  // with x = 1 + 2^-30, y = x * x rounded: fused, what was rounded off remains
}
}  // namespace
#undef JAROL_HAS

/// Why a library of such a build can't be used by one of the other; empty: it can.
std::string find_difference(const PluginBuild& plugin, const PluginBuild& program);

}  // namespace jarol
