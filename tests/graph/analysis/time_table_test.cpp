#include "graph/analysis/time_table.h"

#include <doctest/doctest.h>

#include "tests/graph/graph_of.h"

TEST_SUITE("graph/analysis/time_table") {
  using namespace jarol;
  using namespace jarol::analysis;
  using namespace std::chrono_literals;
  using tests::graph_of;

  TEST_CASE("tasks that fit are schedulable, and their responses are told") {
    const TableResult r = check_table(graph_of(R"(graph: t
tasks:
  a: {type: Counter, period: 10ms, wcet: 2ms}
  b: {type: Counter, period: 20ms, wcet: 5ms}
)"));
    CHECK(r.verdict == Verdict::schedulable);
    CHECK(r.reason == "every job of the time table ends by its deadline");
    CHECK(r.utilisation == doctest::Approx(0.45));
    CHECK(r.response[0] == 2ms);
    CHECK(r.response[1] == 7ms);
  }

  TEST_CASE("the first late job is named with its times") {
    const TableResult r = check_table(graph_of(R"(graph: t
tasks:
  long:  {type: Counter, period: 40ms, wcet: 12ms}
  short: {type: Counter, period: 10ms, wcet: 2ms}
)"));
    CHECK(r.verdict == Verdict::not_schedulable);
    REQUIRE(r.miss.has_value());
    CHECK(r.miss->task == 1);
    CHECK(r.miss->activation == 0);
    CHECK(r.miss->release == 0ms);
    CHECK(r.miss->finish == 14ms);
    CHECK(r.miss->deadline == 10ms);
  }

  TEST_CASE("more than the whole core is never schedulable, by however little") {
    const char* text = R"(graph: t
tasks:
  a: {type: Counter, period: 1s, wcet: 500ms}
  b: {type: Counter, period: 1s, wcet: %s}
)";
    std::string exact(text), over(text);
    exact.replace(exact.find("%s"), 2, "500ms");
    over.replace(over.find("%s"), 2, "500.000001ms");
    CHECK(check_table(graph_of(exact)).verdict == Verdict::schedulable);
    CHECK(check_table(graph_of(over)).verdict == Verdict::not_schedulable);
  }

  TEST_CASE("overload that shows only after the table's reach is found by exact utilisation") {
    const TableResult r = check_table(graph_of(R"(graph: t
tasks:
  a: {type: Counter, period: 999983ns, wcet: 500000ns}
  b: {type: Counter, period: 999979ns, wcet: 500000ns}
)"),
                                      10);
    CHECK(r.verdict == Verdict::not_schedulable);
    CHECK(r.reason == "the tasks need more than the whole core");
  }

  TEST_CASE("a task without a wcet leaves the verdict open and is named") {
    const TableResult r = check_table(graph_of("{graph: t, tasks: {a: {type: Counter, period: 10ms}}}"));
    CHECK(r.verdict == Verdict::unknown);
    CHECK(r.reason == "no 'wcet' is stated for 'a'");
  }

  TEST_CASE("a table of too many jobs leaves the verdict open and says so") {
    const TableResult r = check_table(graph_of(R"(graph: t
tasks:
  a: {type: Counter, period: 999983ns, wcet: 1us}
  b: {type: Counter, period: 999979ns, wcet: 1us}
)"),
                                      1000);
    CHECK(r.verdict == Verdict::unknown);
    CHECK(r.reason == "the periods repeat only after more than 1000 jobs, and none of these is late");
  }
}
