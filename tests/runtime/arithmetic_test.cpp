// Whether what may depend on the processor is found; the vehicles' suite looks at Simbody.
#include "runtime/arithmetic.h"

#include <dlfcn.h>
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <memory>

namespace {

struct Close {
  void operator()(void* library) const { dlclose(library); }
};
using Library = std::unique_ptr<void, Close>;

}  // namespace

TEST_SUITE("runtime/arithmetic") {
  TEST_CASE("all calls of sin and its like, of all libraries, end in this program") {
    const jarol::Arithmetic arithmetic = jarol::find_arithmetic();
    CHECK(arithmetic.foreign_calls == std::vector<std::string>{});
    CHECK(jarol::warnings(arithmetic) == std::vector<std::string>{});
  }

  TEST_CASE("a library whose calls end elsewhere is named") {
    const Library deep(dlopen(JAROL_LIBRARIES "/deep.so", RTLD_NOW | RTLD_DEEPBIND));
    REQUIRE(deep != nullptr);
    const jarol::Arithmetic arithmetic = jarol::find_arithmetic();
    CHECK(arithmetic.foreign_calls == std::vector<std::string>{"deep.so calls sin of libm.so.6"});
    CHECK(
        jarol::warnings(arithmetic) ==
        std::vector<std::string>{"deep.so calls sin of libm.so.6, which may give another digest on another processor"});
  }

  TEST_CASE("the same library, loaded as plugins are, calls this program's") {
    const Library usual(dlopen(JAROL_LIBRARIES "/deep.so", RTLD_NOW | RTLD_LOCAL));
    REQUIRE(usual != nullptr);
    CHECK(jarol::find_arithmetic().foreign_calls == std::vector<std::string>{});
  }

  TEST_CASE("a BLAS that picks by processor is named with its place") {
    const Library product(dlopen(JAROL_LIBRARIES "/openblas/product.so", RTLD_NOW | RTLD_GLOBAL));
    REQUIRE(product != nullptr);
    const jarol::Arithmetic arithmetic = jarol::find_arithmetic();
    const std::string place = std::filesystem::canonical(JAROL_LIBRARIES "/openblas/product.so");
    CHECK(arithmetic.blas == place);
    CHECK(arithmetic.blas_varies);
    CHECK(jarol::warnings(arithmetic) ==
          std::vector<std::string>{"BLAS is " + place + ", which may give another digest on another processor"});
  }
}
