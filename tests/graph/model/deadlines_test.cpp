#include "graph/model/deadlines.h"

#include <doctest/doctest.h>

#include "tests/graph/graph_of.h"

TEST_SUITE("graph/deadlines") {
  using namespace jarol;
  using namespace std::chrono_literals;
  using tests::graph_of;

  TEST_CASE("the least distance to a later instant is the offset difference modulo the common divisor") {
    CHECK(min_distance(10ms, 0ms, 10ms, 0ms) == 10ms);
    CHECK(min_distance(10ms, 0ms, 10ms, 3ms) == 3ms);
    CHECK(min_distance(10ms, 3ms, 10ms, 0ms) == 7ms);
    CHECK(min_distance(10ms, 0ms, 15ms, 2ms) == 2ms);
    CHECK(min_distance(7ns, 1ns, 3ns, 0ns) == 1ns);
  }

  TEST_CASE("with a LET the deadline is the LET") {
    CHECK(graph_of("{graph: t, tasks: {a: {type: Counter, period: 10ms, let: 4ms}}}").tasks[0].deadline == 4ms);
  }

  TEST_CASE("a data-flow task that nobody reads has its period as deadline") {
    CHECK(graph_of("{graph: t, tasks: {a: {type: Counter, period: 10ms}}}").tasks[0].deadline == 10ms);
  }

  TEST_CASE(
      "a data-flow task ends before anything reads its output later, and before the deadline of who latches at its "
      "release") {
    const Graph graph = graph_of(R"(graph: t
tasks:
  a: {type: Counter, period: 10ms}
  b: {type: Relay, period: 10ms, deadline: 6ms}
  c: {type: Relay, period: 20ms, offset: 15ms}
  d: {type: Relay, period: 10ms, let: 4ms}
  e: {type: Counter, period: 20ms}
connections:
  - a.out -> b.in
  - a.out -> d.in
  - e.out -> c.in
)");
    CHECK(graph.tasks[0].deadline == 4ms);   // a: d latches at a's release and has 4 ms
    CHECK(graph.tasks[1].deadline == 6ms);   // b: declared
    CHECK(graph.tasks[2].deadline == 20ms);  // c
    CHECK(graph.tasks[4].deadline == 15ms);  // e: c reads 15 ms later
  }

  TEST_CASE("an `out` that reads an output later is a deadline too; at the release itself it has read before") {
    const auto deadline = [](const std::string& out) {
      return graph_of("graph: t\ncommunicators: {o: {type: double, direction: out" + out +
                      "}}\ntasks: {a: {type: Counter, period: 10ms, offset: 2ms}}\nconnections: [a.out -> o]\n")
          .tasks[0]
          .deadline;
    };
    CHECK(deadline(", period: 10ms, offset: 5ms") == 3ms);
    CHECK(deadline(", period: 10ms, offset: 1ms") == 9ms);
    CHECK(deadline(", period: 10ms, offset: 2ms") == 10ms);
    CHECK(deadline(", period: 4ms") == 2ms);
    CHECK(deadline(", period: 7ms") == 1ms);
    CHECK(deadline(", period: 1h") == 8ms);
  }

  TEST_CASE("a declared deadline may not be later than the derived one") {
    CHECK(tests::report_on("{graph: t, tasks: {a: {type: Counter, period: 10ms, let: 4ms, deadline: 5ms}}}") ==
          "t.yaml:1:73: error: task 'a' has deadline 5ms later than 4ms, which follows from its LET; lower it or leave "
          "it out\n"
          "  {graph: t, tasks: {a: {type: Counter, period: 10ms, let: 4ms, deadline: 5ms}}}\n"
          "                                                                          ^");
  }

  TEST_CASE("a cycle without a LET task is an error that prints the cycle, whatever the offsets") {
    CHECK(tests::report_on(R"(graph: t
tasks:
  c: {type: Relay, period: 10ms}
  a: {type: Relay, period: 10ms}
  b: {type: Relay, period: 10ms, offset: 5ms}
  z: {type: Relay, period: 10ms}
connections:
  - a.out -> b.in
  - b.out -> c.in
  - c.out -> a.in
  - c.out -> z.in
)") == "t.yaml:4:3: error: tasks a -> b -> c -> a feed each other in a cycle without a LET; give one of them a 'let'\n"
       "    a: {type: Relay, period: 10ms}\n"
       "    ^");
  }

  TEST_CASE("a cycle through a LET task is fine, also of a task that feeds itself") {
    CHECK(graph_of("{graph: t, tasks: {a: {type: Relay, period: 10ms, let: 10ms}}, connections: [a.out -> a.in]}")
              .order.size() == 1);
  }
}
