// How code was compiled, as far as a plugin and the program that loads it have to agree: layout and arithmetic. Plain
// numbers that lie in the library's file and are read there, before anything of it runs.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "graph/build_options.h"
#include "graph/registry.h"

namespace jarol {

/// Members of four bytes and bytes alone: no option of a compiler changes where they lie.
struct PluginBuild {
  char magic[16] = {'j', 'a', 'r', 'o', 'l', ' ', 'p', 'l', 'u', 'g', 'i', 'n', ' ', 'o', 'f', ':'};
  std::int32_t form = 12;  // grows with every change of this interface
  BuildOptions options{};
  std::int32_t eigen_alignment = 0;                                               // bytes
  std::int32_t task_class = 0, type = 0, sequence = 0, string = 0, registry = 0;  // bytes
  char compiler[64] = {};
};

/// Of the file that includes this; internal to it, as each is compiled with options of its own.
namespace {
consteval PluginBuild build_of_this_file() {
  PluginBuild build;
  build.options = options_of_this_file();
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

/// Why a library of such a build can't be used by one of the other; empty: it can.
std::string find_difference(const PluginBuild& plugin, const PluginBuild& program);

}  // namespace jarol
