// Simbody's calls, and those of the libraries that it brings.
#include "runtime/machine/arithmetic.h"

#include <dlfcn.h>
#include <doctest/doctest.h>

#include <string>

#include "graph/math/names.h"

TEST_SUITE("vehicles/arithmetic") {
  TEST_CASE("what Simbody and LAPACK call sin, exp and so on is this program's own") {
    // both are there, and would be seen
    REQUIRE(dlsym(RTLD_DEFAULT, "dgemm_") != nullptr);
    std::string foreign;
    for (const std::string& call : jarol::find_arithmetic().foreign_calls) foreign += call + "\n";
    CHECK(foreign == "");
    CHECK(jarol::find_arithmetic().blas != "");
    for (const auto& function : jarol::math::names()) {
      CAPTURE(function.name);
      CHECK(dlsym(RTLD_DEFAULT, function.name) == function.address);
    }
  }
}
