#include "graph/model/build.h"

#include <doctest/doctest.h>

#include "tasks/generic.h"
#include "tests/graph/graph_of.h"

TEST_SUITE("graph/build") {
  using namespace jarol;
  using tests::graph_of;
  using tests::report_on;

  TEST_CASE("tasks and communicators stand in order of name, whatever the order of declaration") {
    const Graph graph = graph_of(R"(graph: t
timing: {period: 10ms}
communicators:
  z: {type: double, direction: out}
  y: {type: double, direction: in, init: 4}
tasks:
  b: {type: Relay}
  a: {type: Relay}
connections:
  - y -> b.in
  - b.out -> a.in
  - a.out -> z
)");
    CHECK(graph.tasks[0].name == "a");
    CHECK(graph.communicators[0].name == "y");
    CHECK(*static_cast<const double*>(graph.communicators[0].init.data()) == 4);
    CHECK(graph.order == std::vector<std::size_t>{1, 0});
  }

  TEST_CASE("what states no period has the graph's") {
    const Graph graph =
        graph_of("{graph: t, timing: {period: 40ms}, tasks: {a: {type: Counter}, b: {type: Counter, period: 10ms}}}");
    CHECK(graph.tasks[0].period == std::chrono::milliseconds(40));
    CHECK(graph.tasks[1].period == std::chrono::milliseconds(10));
  }

  TEST_CASE("all that is wrong with a graph comes in one report, in the order of the file") {
    Registry two;
    two.add(task_class<tasks::Relay>());
    two.add(task_class<tasks::Counter>());
    CHECK(report_on(two, R"(graph: t
tasks:
  count: {type: Countre, period: 10ms}
  slow: {type: Relay, period: 20ms, let: 30ms, colour: red}
connections:
  - count.out -> slow.inn
)") == "t.yaml:3:17: error: task 'count' has unknown type 'Countre'; did you mean 'Counter'?; there are: Counter, "
       "Relay\n"
       "    count: {type: Countre, period: 10ms}\n"
       "                  ^\n"
       "t.yaml:4:42: error: task 'slow' has LET 30ms longer than its period 20ms\n"
       "    slow: {type: Relay, period: 20ms, let: 30ms, colour: red}\n"
       "                                           ^\n"
       "t.yaml:4:48: error: task 'slow' has no key 'colour'; it has: type, period, offset, let, deadline, wcet, "
       "jitter, blocking, "
       "priority, "
       "core, heap, on_fault, fault_limit, isolation, parameters, init\n"
       "    slow: {type: Relay, period: 20ms, let: 30ms, colour: red}\n"
       "                                                 ^\n"
       "t.yaml:6:18: error: task 'slow' (Relay) has no input 'inn'; did you mean 'in'?; it has: in\n"
       "    - count.out -> slow.inn\n"
       "                   ^");
  }

  TEST_CASE("a connection between different types is an error that names both ends and both types") {
    CHECK(report_on(R"(graph: t
timing: {period: 10ms}
communicators:
  i: {type: Motion, direction: in}
tasks:
  a: {type: Relay}
connections:
  - i -> a.in
)") == "t.yaml:8:5: error: connection i -> a.in joins a Motion to a double; both ends must have the same type\n"
       "    - i -> a.in\n"
       "      ^");
  }

  TEST_CASE("an input has one source") {
    CHECK(report_on(R"(graph: t
timing: {period: 10ms}
tasks:
  a: {type: Counter}
  b: {type: Relay}
connections:
  - a.out -> b.in
  - a.out -> b.in
)") == "t.yaml:8:14: error: 'b.in' is fed twice; an input has one source\n"
       "    - a.out -> b.in\n"
       "               ^\n"
       "t.yaml:7:5: note: first here\n"
       "    - a.out -> b.in\n"
       "      ^");
  }

  TEST_CASE("a communicator stands on its own side of an arrow and without a dot") {
    CHECK(report_on(R"(graph: t
timing: {period: 10ms}
communicators:
  o: {type: double, direction: out}
tasks:
  a: {type: Relay}
connections:
  - o -> a.in
  - a.out -> o.x
)") == "t.yaml:8:5: error: communicator 'o' is an 'out' and has an input only; it stands right of an arrow\n"
       "    - o -> a.in\n"
       "      ^\n"
       "t.yaml:9:14: error: communicator 'o' is written without '.x'; only tasks have inputs and outputs\n"
       "    - a.out -> o.x\n"
       "               ^");
  }

  TEST_CASE("the graph's period is a multiple of every period") {
    CHECK(report_on("{graph: t, timing: {period: 15ms}, tasks: {a: {type: Counter, period: 10ms}}}") ==
          "t.yaml:1:71: error: task 'a' has period 10ms, of which the graph's period 15ms is no multiple; change one "
          "of them\n"
          "  {graph: t, timing: {period: 15ms}, tasks: {a: {type: Counter, period: 10ms}}}\n"
          "                                                                        ^");
  }

  TEST_CASE("periods, LETs, deadlines and WCETs are above zero, offsets from zero to below the period") {
    const auto wrong = [](const std::string& keys) {
      const std::string report = report_on("{graph: t, tasks: {a: {type: Counter" + keys + "}}}");
      return report.substr(0, report.find('\n')).substr(report.find("key"));
    };
    for (const std::string key : {"period", "let", "deadline", "wcet"})
      for (const std::string value : {"0ns", "-1ns"}) {
        const std::string period = key == "period" ? "" : ", period: 10ms";
        CHECK(wrong(period + ", " + key + ": " + value) == "key '" + key + "': '" + value + "' is not above zero");
      }
    CHECK(wrong(", period: 10ms, offset: -1ns") == "key 'offset': '-1ns' is below zero");
    CHECK(report_on("{graph: t, tasks: {a: {type: Counter, period: 1ns, offset: 0ns, let: 1ns, deadline: 1ns}}}") ==
          "");
    CHECK(report_on("{graph: t, tasks: {a: {type: Counter, period: 3ns, offset: 2ns, let: 3ns}}}") == "");
    CHECK(report_on("graph: t\ncommunicators:\n  i: {type: double, direction: in, period: 3ns, offset: 3ns}\n"
                    "  o: {type: double, direction: out, period: 3ns, offset: 2ns}\nconnections: [i -> o]\n") ==
          "t.yaml:3:57: error: communicator 'i' has offset 3ns not below its period 3ns\n"
          "    i: {type: double, direction: in, period: 3ns, offset: 3ns}\n"
          "                                                          ^");
  }

  TEST_CASE("an output feeds any number of inputs, and may stay open") {
    const Graph graph = graph_of(R"(graph: t
timing: {period: 10ms}
communicators: {o: {type: double, direction: out}}
tasks:
  a: {type: Counter}
  b: {type: Sum}
  open: {type: Counter}
connections: [a.out -> b.a, a.out -> b.b, a.out -> o]
)");
    CHECK(graph.connections.size() == 3);
  }

  TEST_CASE("what is planned for later says that it is not supported yet") {
    CHECK(report_on("graph: t\nmodes: {}\nconnections:\n  - {connect: a.x -> b.y}\n") ==
          "t.yaml:2:1: error: 'modes' is not supported yet; leave it out\n"
          "  modes: {}\n"
          "  ^\n"
          "t.yaml:4:5: error: annotations of connections are not supported yet; write 'from.output -> to.input'\n"
          "    - {connect: a.x -> b.y}\n"
          "      ^");
  }

  TEST_CASE("parameters are bound by name, with what would be right") {
    CHECK(report_on("{graph: t, tasks: {a: {type: Work, period: 1ms, parameters: {rounds: many, size: 1}}}}") ==
          "t.yaml:1:70: error: task 'a' (Work) parameter 'rounds' needs a uint32, not 'many'; that is not an integer\n"
          "  {graph: t, tasks: {a: {type: Work, period: 1ms, parameters: {rounds: many, size: 1}}}}\n"
          "                                                                       ^\n"
          "t.yaml:1:76: error: task 'a' (Work) has no parameter 'size'; it has: rounds\n"
          "  {graph: t, tasks: {a: {type: Work, period: 1ms, parameters: {rounds: many, size: 1}}}}\n"
          "                                                                             ^");
  }
}
