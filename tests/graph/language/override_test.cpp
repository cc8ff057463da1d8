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

  TEST_CASE("what is wrong with a value of --set is shown in the argument, and so is where it began") {
    CHECK(report_on(counting, {"", {"tasks.count.wcet=\"3ms"}}) ==
          "--set:1:22: error: not valid YAML: found unexpected end of stream\n"
          "  tasks.count.wcet=\"3ms\n"
          "                       ^\n"
          "--set:1:18: note: while scanning a quoted scalar, from here on\n"
          "  tasks.count.wcet=\"3ms\n"
          "                   ^");
    CHECK(graph_of(counting, {"", {"tasks.count.wcet=\t 2us"}}).tasks[0].wcet == std::chrono::microseconds(2));
  }

  TEST_CASE("--set may add a key to a task that exists") {
    CHECK(graph_of(counting, {"", {"tasks.count.wcet=2us"}}).tasks[0].wcet == std::chrono::microseconds(2));
    CHECK(graph_of(counting, {"", {"timing.period=40ms"}}).period == std::chrono::milliseconds(40));
  }

  TEST_CASE("a profile changes values by the same rule, and --set comes after it") {
    CHECK(graph_of(counting, {"slow", {}}).tasks[0].period == std::chrono::milliseconds(40));
    CHECK(graph_of(counting, {"slow", {"tasks.count.period=20ms"}}).tasks[0].period == std::chrono::milliseconds(20));
  }

  TEST_CASE("an override of a profile is an error, as it would change nothing") {
    CHECK(
        report_on(counting, {"slow", {"profiles.slow.tasks.count.period=20ms"}}) ==
        "--set:1:1: error: path 'profiles.slow.tasks.count.period' changes nothing, as profiles are applied before it; "
        "set what the profile sets, as in tasks.depth.period=20ms\n"
        "  profiles.slow.tasks.count.period=20ms\n"
        "  ^");
    CHECK(report_on(counting, {"", {"profiles={}"}}).find("path 'profiles' changes nothing") != std::string::npos);
    CHECK(report_on(counting + "  other: {profiles.slow: null}\n", {"other", {}})
              .find("'profiles.slow' changes nothing") != std::string::npos);
  }

  TEST_CASE("null takes a key away, as if it did not stand there") {
    const std::string let =
        "graph: t\ntasks:\n  a: {type: Relay, period: 10ms, let: 5ms, init: {out: 2}}\n"
        "connections: [a.out -> a.in]\nplatform: {cores: 2}\n"
        "profiles: {one: {platform: ~}, flow: {tasks.a.let: null}}\n";
    CHECK(graph_of(let).platform.cores == 2);
    CHECK(graph_of(let, {"one", {}}).platform.cores == 1);
    CHECK(graph_of(let, {"", {"tasks.a.let=7ms"}}).tasks[0].let == std::chrono::milliseconds(7));
    const std::string cycle = report_on(let, {"flow", {}});
    CHECK(cycle.find("tasks a -> a feed each other in a cycle without a LET") != std::string::npos);
    CHECK(report_on(let, {"", {"tasks.a.let=null"}}) == cycle);
    // what is taken away can be given again, and nothing more is taken
    CHECK(graph_of(let, {"flow", {"tasks.a.let=6ms"}}).tasks[0].let == std::chrono::milliseconds(6));
    CHECK(graph_of(let, {"", {"tasks.a.init.out=null"}}).tasks[0].period == std::chrono::milliseconds(10));
  }

  TEST_CASE("what is not there can't be taken away, and no value is none") {
    CHECK(report_on(counting, {"", {"tasks.count.perod=null"}}) ==
          "--set:1:1: error: path 'tasks.count.perod': 'tasks.count' has no 'perod' that could be taken away; did you "
          "mean 'period'?; it has: type, period\n"
          "  tasks.count.perod=null\n"
          "  ^");
    CHECK(
        report_on(counting, {"", {"platform.cores=~"}}) ==
        "--set:1:1: error: path 'platform.cores': the graph has no 'platform' that could be taken away; it has: graph, "
        "tasks, profiles\n"
        "  platform.cores=~\n"
        "  ^");
    CHECK(report_on(counting, {"", {"tasks.count=null"}}) ==
          "t.yaml:1:1: error: the graph holds no task, communicator or distributer; add a task below 'tasks:'\n"
          "  graph: t\n"
          "  ^");
    CHECK(report_on(counting, {"", {"tasks.count.period="}}) ==
          "--set:1:20: error: 'tasks.count.period=' gives no value; write path=value, as in tasks.depth.period=20ms\n"
          "  tasks.count.period=\n"
          "                     ^");
  }

  TEST_CASE("an override of what is not there is an error that points into the argument") {
    CHECK(report_on(counting, {"", {"tasks.cont.period=20ms"}}) ==
          "--set:1:1: error: path 'tasks.cont.period': 'tasks' has no 'cont'; did you mean 'count'?; it has: count\n"
          "  tasks.cont.period=20ms\n"
          "  ^");
    CHECK(
        report_on(counting, {"", {"tasks.count.perod=20ms"}}) ==
        "--set:1:1: error: task 'count' has no key 'perod'; did you mean 'period'?; it has: type, period, offset, let, "
        "deadline, wcet, jitter, blocking, priority, core, heap, on_fault, fault_limit, isolation, parameters, init\n"
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

  TEST_CASE("each path that a campaign varies is tried on the graph as it is, whatever the others change") {
    const auto report_of = [](const std::string& vary) {
      return report_on("graph: t\ntasks: {a: {type: Counter, period: 1s, wcet: 1ms}}\ncampaign: {vary: {" + vary +
                       "}}\n");
    };
    CHECK(report_of("tasks.a: [1], tasks.a.wcet: [1ms, 2ms], tasks: [1], tasks.a.jitter: [1ms]") == "");
    CHECK(report_of("tasks.a.wcet: [1ms], tasks.b.wcet: [1ms]").find("path 'tasks.b.wcet': 'tasks' has no 'b'") !=
          std::string::npos);
  }
}
