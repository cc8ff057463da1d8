#include "graph/analysis/global_edf.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol::analysis;
using namespace std::chrono_literals;
using Responses = std::vector<std::optional<jarol::Duration>>;
}  // namespace

TEST_SUITE("graph/analysis/global_edf") {
  TEST_CASE("bounds of responses are looked for within a budget, and are left out where that is spent") {
    const TaskModels models(3, {.wcet = 2ns, .period = 10ns, .deadline = 10ns});
    Budget enough{1'000}, scarce{12};
    CHECK(global_edf_responses(models, 2, enough) == Responses{4ns, 4ns, 4ns});
    CHECK(enough.left == 1'000 - 3 * 3 * 6);
    CHECK(global_edf_responses(models, 2, scarce) == Responses(3));
    CHECK(scarce.spent());
  }
}
