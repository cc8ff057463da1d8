// Whether what may depend on the processor is found; the vehicles' suite looks at Simbody.
#include "runtime/machine/arithmetic.h"

#include <dlfcn.h>
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace {

struct Close {
  void operator()(void* library) const { dlclose(library); }
};
using Library = std::unique_ptr<void, Close>;

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

// Without BLAS: once it was found by its name, the C library keeps it, whichever case did so.
std::string warnings_of_calls(const jarol::Arithmetic& found) {
  return joined(jarol::warnings({.foreign_calls = found.foreign_calls, .blas = {}, .blas_varies = false}));
}

}  // namespace

TEST_SUITE("runtime/arithmetic") {
  TEST_CASE("all calls of sin and its like, of all libraries, end in this program") {
    const jarol::Arithmetic arithmetic = jarol::find_arithmetic();
    CHECK(joined(arithmetic.foreign_calls) == "");
    CHECK(warnings_of_calls(arithmetic) == "");
  }

#ifndef JAROL_SANITIZED  // they refuse to load a library so
  TEST_CASE("a library whose calls end elsewhere is named") {
    const Library deep(dlopen(JAROL_LIBRARIES "/deep.so", RTLD_NOW | RTLD_DEEPBIND));
    REQUIRE(deep != nullptr);
    const jarol::Arithmetic arithmetic = jarol::find_arithmetic();
    CHECK(joined(arithmetic.foreign_calls) == "deep.so calls sin of libm.so.6\n");
    CHECK(warnings_of_calls(arithmetic) ==
          "deep.so calls sin of libm.so.6, which may give another digest on another processor\n");
  }

#endif

  TEST_CASE("the same library, loaded as plugins are, calls this program's") {
    const Library usual(dlopen(JAROL_LIBRARIES "/deep.so", RTLD_NOW | RTLD_LOCAL));
    REQUIRE(usual != nullptr);
    CHECK(joined(jarol::find_arithmetic().foreign_calls) == "");
  }

  TEST_CASE("a BLAS that picks by processor is named with its place") {
    const Library product(dlopen(JAROL_LIBRARIES "/openblas/product.so", RTLD_NOW | RTLD_GLOBAL));
    REQUIRE(product != nullptr);
    const jarol::Arithmetic arithmetic = jarol::find_arithmetic();
    const std::string place = std::filesystem::canonical(JAROL_LIBRARIES "/openblas/product.so");
    CHECK(arithmetic.blas == place);
    CHECK(arithmetic.blas_varies);
    CHECK(joined(jarol::warnings(arithmetic)) ==
          "BLAS is " + place + ", which may give another digest on another processor\n");
  }
}
