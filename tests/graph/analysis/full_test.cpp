// Close to full utilisation busy periods are very long; one hyperperiod shows all of them.
#include <doctest/doctest.h>

#include "graph/analysis/sensitivity.h"
#include "tests/graph/analysis/milliseconds.h"

namespace {
using namespace jarol::analysis;
using namespace std::chrono_literals;
using jarol::Duration;
using jarol::Policy;
namespace policies = jarol::policies;

using jarol::tests::ms;

// 1 - 2.5e-9 of a core, and so as long as the last task takes no longer.
System nearly_full(const Policy& policy, Duration last) {
  System system;
  system.policy = policy;
  system.offsets_hold = false;
  const Duration periods[] = {100 * ms, 200 * ms, 400 * ms, 400 * ms};
  for (std::size_t i = 0; i < 4; ++i) {
    system.models.push_back({.wcet = i == 3 ? last : 50 * ms, .period = periods[i], .deadline = periods[i]});
    system.rank.push_back(i);
    system.turn.push_back(i);
  }
  system.priority.resize(4);
  system.core.resize(4);
  return system;
}
}  // namespace

TEST_SUITE("graph/analysis/full") {
  TEST_CASE("a core that is all but full is decided, whatever the policy") {
    for (const Policy& policy : {policies::edf, policies::edf_nonpreemptive, policies::fixed_priority,
                                 policies::fixed_priority_nonpreemptive}) {
      CAPTURE(policy.name);
      const Result holds = check(nearly_full(policy, 50 * ms - 1ns));
      CHECK(holds.verdict == Verdict::schedulable);
      CHECK(holds.evidence == Evidence::proof);
      const Result over = check(nearly_full(policy, 50 * ms + 1ns));
      CHECK(over.verdict == Verdict::not_schedulable);
    }
  }

  TEST_CASE("a verdict that would take more effort is given up, and not the one after it") {
    const System system = nearly_full(policies::edf_nonpreemptive, 50 * ms - 1ns);
    Budget little{20}, enough{1'000};
    CHECK(verdict_of(system, little) == Verdict::unknown);
    CHECK(little.spent());
    CHECK(!sensitivity_of(system, true, little).has_value());
    CHECK(wcet_cuts(system, little).empty());
    CHECK(verdict_of(system, enough) == Verdict::schedulable);
    CHECK(!enough.spent());
    CHECK(!sensitivity_of(system, true, enough).has_value());
    Budget unlimited;
    REQUIRE(sensitivity_of(system, true, unlimited).has_value());
    CHECK(sensitivity_of(system, true, unlimited)->max_wcet[3] == 50 * ms);
  }
}
