#include "graph/analysis/policies.h"

#include <doctest/doctest.h>

#include "graph/analysis/check.h"
#include "graph/language/problems.h"
#include "graph/registry.h"
#include "graph/text/errors.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;

// Never sure.
struct Doubtful {
  static constexpr std::string_view name = "doubtful", how = "tasks run as they like";
  static constexpr Urgency urgency = Urgency::deadline;
  static constexpr bool interrupts = true;
  static analysis::Result check(const analysis::System&, bool, analysis::Budget&) {
    analysis::Result result;
    result.reason = "nobody knows";
    return result;
  }
};
struct Roaming : Doubtful {
  static constexpr bool keeps_core = false;
};

const std::string counting = "graph: t\ntasks: {a: {type: Counter, period: 1s, wcet: 1ms}}\n";
}  // namespace

TEST_SUITE("graph/analysis/policies") {
  TEST_CASE("each policy has a name of its own, says how tasks run, and is found in the registry") {
    const Registry& registry = tests::generic_tasks();
    REQUIRE(!analysis::built_in_policies().empty());
    CHECK(registry.policies() == analysis::built_in_policies());
    for (const Policy& policy : analysis::built_in_policies()) {
      CAPTURE(policy.name);
      CHECK(*registry.find_policy(policy.name) == policy);
      CHECK(!policy.how.empty());
      CHECK((policy.check != nullptr));
    }
    Registry more = registry;
    CHECK_THROWS_WITH_AS(more.add(policies::edf), "there is a 'edf' already; names are unique", InputError);
  }

  TEST_CASE("under global EDF alone a task has no core of its own, and 'run' executes the first two") {
    for (const Policy& policy : analysis::built_in_policies()) {
      CHECK(policy.keeps_core == (policy != policies::global_edf));
      CHECK(policy.executed == (policy == policies::table || policy == policies::fixed_priority));
    }
  }

  TEST_CASE("a graph has the policy that its platform names, and goes by a table where it names none") {
    for (const Policy& policy : analysis::built_in_policies()) {
      const Graph graph = tests::graph_of(counting + "platform: {policy: " + std::string(policy.name) + "}\n");
      CHECK(analysis::policy_of(graph.platform) == policy);
      CHECK(analysis::system_of(graph).policy == policy);
    }
    for (const char* platform : {"", "platform: {cores: 2}\n"})
      CHECK(analysis::policy_of(tests::graph_of(counting + platform).platform) == policies::table);
  }

  TEST_CASE("a policy made of a struct has what it says, and may leave responses and cores open") {
    const Policy doubtful = analysis::make_policy<Doubtful>();
    CHECK(doubtful.name == "doubtful");
    CHECK(doubtful.how == "tasks run as they like");
    CHECK(doubtful.urgency == Urgency::deadline);
    CHECK((doubtful.interrupts && doubtful.keeps_core && !doubtful.executed));
    CHECK_FALSE(analysis::make_policy<Roaming>().keeps_core);
    Registry registry = tests::generic_tasks();
    registry.add(doubtful);
    const Graph graph = tests::graph_of(registry, counting + "platform: {policy: doubtful}\n");
    const analysis::Result result = analysis::check(graph);
    CHECK(result.verdict == analysis::Verdict::unknown);
    CHECK(result.reason == "nobody knows");
    CHECK(result.response.size() == 1);
    CHECK(result.core.size() == 1);
    CHECK(result.utilisation == 0.001);
  }

  TEST_CASE("what is no policy is refused with those that the registry has") {
    const std::string line = counting + "platform: {policy: ";
    const std::string all = list_of(names_of(analysis::built_in_policies()));
    CHECK(tests::report_on(line + "round}\n")
              .find("t.yaml:3:20: error: 'platform' key 'policy' can't be 'round'; it is one of " + all + "\n") == 0);
    CHECK(
        tests::report_on(line + "fixed_prioritys}\n").find("; did you mean 'fixed_priority'?; it is one of table, ") !=
        std::string::npos);
    CHECK(tests::report_on(line + "[edf]}\n")
              .find("t.yaml:3:20: error: 'platform' key 'policy' needs one of " + all + ", not a list\n") == 0);
    CHECK(tests::report_on(line + "}\n") != "");
  }
}
