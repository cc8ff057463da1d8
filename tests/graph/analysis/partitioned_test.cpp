// What a check of cores that wait for each other takes, in steps.
#include <doctest/doctest.h>

#include "graph/analysis/check.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Each task follows the one before it, which is on the other core.
Graph alternating_chain(int count, const std::string& policy) {
  std::string text = "graph: t\nplatform: {policy: " + policy + ", cores: 2}\ntasks:\n", connections = "connections:\n";
  for (int i = 0; i < count; ++i) {
    const std::string name = "t" + std::to_string(100 + i);
    text += "  " + name + ": {type: " + (i == 0 ? "Counter" : "Relay") +
            ", period: 1s, wcet: 1us, core: " + std::to_string(i % 2) + "}\n";
    if (i > 0) connections += "  - t" + std::to_string(99 + i) + ".out -> " + name + ".in\n";
  }
  return tests::graph_of(text + connections);
}
}  // namespace

TEST_SUITE("graph/analysis/partitioned") {
  TEST_CASE("however often two cores wait for each other, their orders are explored within one limit") {
    for (const std::string policy : {"fixed_priority_nonpreemptive", "edf_nonpreemptive"}) {
      CAPTURE(policy);
      const analysis::System system = analysis::system_of(alternating_chain(40, policy));
      for (const bool whole : {false, true}) {
        CAPTURE(whole);
        analysis::Budget budget;
        const std::uint64_t given = budget.left;
        const analysis::Result result = system.policy.check(system, whole, budget);
        CHECK(result.verdict == analysis::Verdict::schedulable);
        CHECK(result.evidence == analysis::Evidence::safe);
        CHECK(given - budget.left < (whole ? 8'000'000 : 1'000'000));
      }
    }
  }

  TEST_CASE("of a chain over two cores that is short each order is explored, and responses are those of the orders") {
    const analysis::Result result = analysis::check(alternating_chain(6, "fixed_priority_nonpreemptive"));
    CHECK(
        result.reason ==
        "every activation ends by its deadline in every order that is possible (schedule-abstraction graph), with the "
        "longest waits for those that they follow (holistic analysis)");
    CHECK(result.response ==
          std::vector<std::optional<Duration>>{1'000ns, 2'999ns, 4'998ns, 6'997ns, 7'997ns, 8'997ns});
  }
}
