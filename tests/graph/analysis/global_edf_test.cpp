#include "graph/analysis/global_edf.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol::analysis;
}  // namespace

TEST_SUITE("graph/analysis/global_edf") {
  TEST_CASE("bounds of responses are looked for within a budget, and are left out where that is spent") {
    const TaskModels models(3, {.wcet = 2, .period = 10, .deadline = 10});
    Budget enough{1'000}, scarce{12};
    CHECK(global_edf_responses(models, 2, enough) == std::vector<std::optional<std::int64_t>>{4, 4, 4});
    CHECK(enough.left == 1'000 - 3 * 3 * 6);
    CHECK(global_edf_responses(models, 2, scarce) == std::vector<std::optional<std::int64_t>>(3));
    CHECK(scarce.spent());
  }
}
