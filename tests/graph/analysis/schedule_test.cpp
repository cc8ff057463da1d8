// What a platform makes of given execution times, by hand; tests/runtime/execution_test.cpp has random graphs.
#include <doctest/doctest.h>

#include "graph/analysis/execution_times.h"
#include "graph/text/errors.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using analysis::ExecutionTimes, analysis::Fate, analysis::Schedule;

// Fates of the first activations of a task: "3", "late 12", "late", "left out", in ms.
std::string fates(Schedule& schedule, std::size_t task, std::int64_t count) {
  std::string text;
  for (std::int64_t i = 0; i < count; ++i) {
    const Fate& fate = schedule.fate(task, i);
    if (i > 0) text += ", ";
    if (fate.kind == Fate::Kind::left_out) text += "left out";
    if (fate.kind == Fate::Kind::late) text += fate.response ? "late " : "late";
    if (fate.response) text += std::to_string(*fate.response / 1ms);
  }
  return text;
}

const std::string two = R"(graph: t
timing: {period: 20ms}
tasks:
  a: {type: Counter, period: 10ms, wcet: 3ms}
  b: {type: Counter, wcet: 8ms}
)";

Schedule scheduled(const std::string& text, const std::string& times) {
  const Graph graph = tests::graph_of(text);
  if (times.empty()) return schedule_of(graph, ExecutionTimes::wcet(graph));
  Problems problems;
  const auto source = std::make_shared<Source>(Source{"times.yaml", times});
  ExecutionTimes read = ExecutionTimes::read(graph, source, 0, problems);
  problems.throw_if_any();
  return schedule_of(graph, std::move(read));
}

std::string problems_of(const std::string& times) {
  try {
    scheduled(two, times);
  } catch (const SpecError& error) {
    std::string text;
    for (const Problem& problem : error.problems()) {
      const std::string whole = to_text(problem);
      text += whole.substr(0, whole.find('\n') + 1);
    }
    return text;
  }
  return "";
}
}  // namespace

TEST_SUITE("graph/analysis/schedule") {
  TEST_CASE("in a table nothing is interrupted; with fixed priorities the more urgent one interrupts") {
    Schedule table = scheduled(two + "platform: {policy: table}\n", "");
    CHECK(fates(table, 0, 4) == "3, 4, 3, 4");
    CHECK(fates(table, 1, 2) == "11, 11");
    Schedule urgent = scheduled(two + "platform: {policy: fixed_priority}\n", "");
    CHECK(fates(urgent, 0, 4) == "3, 3, 3, 3");
    CHECK(fates(urgent, 1, 2) == "14, 14");
  }

  TEST_CASE("what still runs when it is released again is late, and that release is left out") {
    Schedule table = scheduled(two, "a: [3ms, 25ms, 1ms]\nb: 1ms");
    CHECK(fates(table, 0, 8) == "3, late, left out, left out, late, left out, left out, late");
  }

  TEST_CASE("a task with skip leaves out a release after one that was late") {
    const std::string skips = R"(graph: t
timing: {period: 10ms}
tasks:
  a: {type: Counter, wcet: 2ms, deadline: 5ms, on_fault: skip}
)";
    Schedule schedule = scheduled(skips, "a: [6ms, 1ms, 12ms, 1ms]");
    // after 6 ms, which are late, the next one takes no time; 12 ms reach the next release: that is the one left out
    CHECK(fates(schedule, 0, 6) == "late 6, , late, left out, late 6, ");
  }

  TEST_CASE("those behind a reader that waits for another core wait too in a table, and run under other policies") {
    const std::string beside = R"(graph: t
timing: {period: 20ms}
tasks:
  feeds: {type: Counter, wcet: 5ms, core: 0}
  reads: {type: Relay, wcet: 1ms, core: 1}
  zlast: {type: Counter, wcet: 2ms, core: 1, offset: 1ms}
connections: [feeds.out -> reads.in]
platform: {cores: 2, policy: POLICY}
)";
    const auto last = [&](const std::string& policy) {
      std::string text = beside;
      text.replace(text.find("POLICY"), 6, policy);
      Schedule schedule = scheduled(text, "");
      CHECK(fates(schedule, 1, 2) == "6, 6");
      return fates(schedule, 2, 2);
    };
    CHECK(last("table") == "7, 7");  // from 6 ms to 8 ms
    CHECK(last("fixed_priority") == "2, 2");
    CHECK(last("edf") == "2, 2");
    CHECK(last("edf_nonpreemptive") == "2, 2");
  }

  TEST_CASE("a reader waits for what feeds it at its instant, also on another core") {
    const std::string chain = R"(graph: t
timing: {period: 20ms}
tasks:
  feeds: {type: Counter, wcet: 5ms, core: 0}
  reads: {type: Relay, wcet: 1ms, core: 1}
  zlast: {type: Relay, wcet: 1ms, core: 1}
connections: [feeds.out -> reads.in, reads.out -> zlast.in]
platform: {cores: 2, policy: POLICY}
)";
    for (const std::string policy : {"table", "fixed_priority", "edf", "edf_nonpreemptive", "global_edf"}) {
      CAPTURE(policy);
      std::string text = chain;
      text.replace(text.find("POLICY"), 6, policy);
      if (policy == "global_edf")
        for (const std::string core : {", core: 0", ", core: 1", ", core: 1"}) text.erase(text.find(core), core.size());
      Schedule schedule = scheduled(text, "");
      CHECK(fates(schedule, 0, 2) == "5, 5");
      CHECK(fates(schedule, 1, 2) == "6, 6");
      CHECK(fates(schedule, 2, 2) == "7, 7");
    }
  }

  TEST_CASE("overheads of the platform count for each activation") {
    Schedule schedule = scheduled(two + "platform: {dispatch: 2ms}\n", "a: 1ms\nb: 1ms");
    CHECK(fates(schedule, 0, 2) == "3, 3");
    CHECK(fates(schedule, 1, 1) == "6");
  }

  TEST_CASE("what is asked for again is found from the start") {
    Schedule schedule = scheduled(two, "a: [1ms, 2ms, 3ms]\nb: 1ms");
    CHECK(fates(schedule, 0, 5) == "1, 2, 3, 1, 2");
    CHECK(fates(schedule, 0, 5) == "1, 2, 3, 1, 2");
  }

  TEST_CASE("random times are of 1 ns to the WCET, by seed, and the same for a task whatever others there are") {
    const Graph graph = tests::graph_of(two);
    const ExecutionTimes one = ExecutionTimes::random(graph, 1), same = ExecutionTimes::random(graph, 1),
                         other = ExecutionTimes::random(graph, 2);
    const Graph alone = tests::graph_of("graph: t\ntiming: {period: 20ms}\ntasks: {b: {type: Counter, wcet: 8ms}}\n");
    Duration min = 8ms, max{}, sum{};
    bool differs = false;
    for (std::int64_t i = 0; i < 4000; ++i) {
      const Duration time = one(1, i);
      CHECK(time == same(1, i));
      CHECK(time == ExecutionTimes::random(alone, 1)(0, i));
      differs = differs || time != other(1, i);
      min = std::min(min, time);
      max = std::max(max, time);
      sum += time;
    }
    CHECK(differs);
    CHECK(min >= 1ns);
    CHECK(min < 40us);
    CHECK(max <= 8ms);
    CHECK(max > 7'960us);
    CHECK(sum.count() / 4000 == doctest::Approx(4e6).epsilon(0.03).scale(0));  // four deviations of the mean
  }

  TEST_CASE("all that is wrong with a file of times is reported with its place") {
    CHECK(problems_of("a: fast\nb: [1ms, 2s..1s, -1ms]\nwheel: 1ms\n") ==
          "times.yaml:1:4: error: execution time of task 'a': 'fast' is not a duration; write a number and a unit, as "
          "in 10ms\n"
          "times.yaml:2:10: error: execution time of task 'b': '2s..1s' ends below its begin; write it as in 80us or "
          "20us..80us\n"
          "times.yaml:2:18: error: execution time of task 'b': '-1ms' is below zero; write it as in 80us or "
          "20us..80us\n"
          "times.yaml:3:1: error: there is no task 'wheel'; there are: a, b\n");
    CHECK(problems_of("[1ms]") == "times.yaml:1:1: error: execution times need a mapping of tasks, not a list\n");
    CHECK(problems_of("a: []") ==
          "times.yaml:1:4: error: execution time of task 'a' is an empty list; it needs one at least\n");
  }

  TEST_CASE("without a WCET, and without offsets that hold, there is no schedule") {
    const Graph none = tests::graph_of("graph: t\ntasks: {a: {type: Counter, period: 10ms}}\n");
    CHECK_THROWS_WITH_AS(schedule_of(none, ExecutionTimes::wcet(none)),
                         "task 'a' has no 'wcet', by which tasks are given to cores", InputError);
    const Graph any = tests::graph_of(two + "platform: {policy: edf, phasing: any}\n");
    CHECK_THROWS_WITH_AS(schedule_of(any, ExecutionTimes::wcet(any)),
                         "'phasing: any' leaves open when tasks are released; state 'phasing: given'", InputError);
  }
}
