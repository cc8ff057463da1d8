#include <doctest/doctest.h>

#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
const std::string counting = R"(graph: t
tasks:
  count: {type: Counter, period: 10ms}
profiles:
  slow:
    tasks.count.period: 40ms
)";
}  // namespace

TEST_SUITE("graph/spec/override") {
  using tests::graph_of;
  using tests::report_on;

  TEST_CASE("--set changes a value of the file") {
    CHECK(graph_of(counting, {"", {"tasks.count.period=20ms"}}).tasks[0].period == std::chrono::milliseconds(20));
  }

  TEST_CASE("--set may add a key to a task that exists") {
    CHECK(graph_of(counting, {"", {"tasks.count.wcet=2us"}}).tasks[0].wcet == std::chrono::microseconds(2));
    CHECK(graph_of(counting, {"", {"timing.period=40ms"}}).period == std::chrono::milliseconds(40));
  }

  TEST_CASE("a profile changes values by the same rule, and --set comes after it") {
    CHECK(graph_of(counting, {"slow", {}}).tasks[0].period == std::chrono::milliseconds(40));
    CHECK(graph_of(counting, {"slow", {"tasks.count.period=20ms"}}).tasks[0].period == std::chrono::milliseconds(20));
  }

  TEST_CASE("an override of what is not there is an error that points into the argument") {
    CHECK(report_on(counting, {"", {"tasks.cont.period=20ms"}}) ==
          "--set:1:1: error: path 'tasks.cont.period': 'tasks' has no 'cont'; did you mean 'count'?; it has: count\n"
          "  tasks.cont.period=20ms\n"
          "  ^");
    CHECK(
        report_on(counting, {"", {"tasks.count.perod=20ms"}}) ==
        "--set:1:1: error: task 'count' has no key 'perod'; did you mean 'period'?; it has: type, period, offset, let, "
        "deadline, wcet, jitter, blocking, priority, core, heap, on_fault, isolation, parameters, init\n"
        "  tasks.count.perod=20ms\n"
        "  ^");
    CHECK(report_on(counting, {"", {"tasks.count.period=20"}}) ==
          "--set:1:20: error: task 'count' key 'period': '20' has no unit; write one of h, min, s, ms, us or ns, as in "
          "10ms\n"
          "  tasks.count.period=20\n"
          "                     ^");
    CHECK(report_on(counting, {"", {"period"}}) ==
          "--set:1:1: error: 'period' is no override; write path=value, as in tasks.depth.period=20ms\n"
          "  period\n"
          "  ^");
    CHECK(report_on(counting, {"fast", {}}) ==
          "t.yaml:1:1: error: there is no profile 'fast'; the graph has: slow\n"
          "  graph: t\n"
          "  ^");
  }
}
