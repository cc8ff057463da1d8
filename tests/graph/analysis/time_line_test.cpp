#include "graph/analysis/time_line.h"

#include <doctest/doctest.h>

#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// "a 0-2, b 2-11; until 20", in ms
std::string line_text(const std::string& text) {
  const Graph graph = tests::graph_of(text);
  const analysis::System system = analysis::system_of(graph);
  const analysis::TimeLine line = analysis::time_line_of(system, analysis::check(system));
  std::string found;
  for (const analysis::Slice& s : line.slices)
    found += graph.tasks[s.task].name + " " + std::to_string(s.begin / 1ms) + "-" + std::to_string(s.end / 1ms) + ", ";
  return found + "until " + std::to_string(line.until / 1ms);
}

// The second is released while the first runs, for the second time.
std::string two_tasks(const std::string& platform) {
  return "graph: t\nplatform: {" + platform +
         "}\ntasks:\n"
         "  a: {type: Counter, period: 10ms, wcet: 2ms}\n"
         "  b: {type: Counter, period: 20ms, wcet: 9ms, deadline: 15ms}\n";
}
}  // namespace

TEST_SUITE("graph/analysis/time_line") {
  TEST_CASE("a table goes in the order of releases, and nothing interrupts") {
    CHECK(line_text(two_tasks("policy: table")) == "a 0-2, b 2-11, a 11-13, until 20");
    // at one instant the one that is due sooner
    CHECK(line_text("graph: t\ntasks:\n  a: {type: Counter, period: 20ms, wcet: 4ms}\n"
                    "  b: {type: Counter, period: 10ms, wcet: 2ms}\n") == "b 0-2, a 2-6, b 10-12, until 20");
  }

  TEST_CASE("the more urgent task interrupts under fixed priorities, but not without preemption") {
    CHECK(line_text(two_tasks("policy: fixed_priority")) == "a 0-2, b 2-10, a 10-12, b 12-13, until 20");
    CHECK(line_text(two_tasks("policy: fixed_priority_nonpreemptive")) == "a 0-2, b 2-11, a 11-13, until 20");
  }

  TEST_CASE("the earlier deadline goes first, on one core or on any") {
    CHECK(line_text(two_tasks("policy: edf")) == "a 0-2, b 2-11, a 11-13, until 20");
    CHECK(line_text(two_tasks("policy: global_edf, cores: 2")) == "a 0-2, b 0-9, a 10-12, until 20");
  }

  TEST_CASE("it repeats from the second hyperperiod on, or at once where all begin at zero, if all of it is drawn") {
    const auto line = [](const std::string& keys, const analysis::TimeLineLength& length) {
      const Graph graph = tests::graph_of(
          "graph: t\ntasks:\n  a: {type: Counter, period: 10ms, wcet: 2ms}\n"
          "  b: {type: Counter, period: 20ms, wcet: 1ms" +
          keys + "}\n");
      const analysis::System system = analysis::system_of(graph);
      return analysis::time_line_of(system, analysis::check(system), length);
    };
    CHECK(line("", {}).round == 20ms);
    CHECK(line("", {.until_it_repeats = true}).until == 20ms);
    CHECK(line(", offset: 5ms", {}).until == 25ms);
    CHECK(!line(", offset: 5ms", {}).round);
    CHECK(line(", offset: 5ms", {.until_it_repeats = true}).until == 45ms);
    CHECK(line(", offset: 5ms", {.until_it_repeats = true}).round == 20ms);
    CHECK(!line(", offset: 5ms", {.until_it_repeats = true, .max_activations = 5}).round);
    CHECK(line("", {.max_activations = 1}).until < 20ms);
  }

  TEST_CASE("tasks on cores of their own do not wait for each other, readers wait for what they follow") {
    const std::string tasks = R"(graph: t
platform: {policy: table, cores: 2}
timing: {period: 10ms}
tasks:
  a: {type: Counter, wcet: 3ms, core: 0}
  b: {type: Relay, wcet: 4ms, core: 1}
)";
    CHECK(line_text(tasks + "connections: [a.out -> b.in]\n") == "a 0-3, b 3-7, until 10");
    CHECK(line_text(tasks + "  c: {type: Counter, wcet: 1ms, core: 1}\nconnections: [c.out -> b.in]\n") ==
          "a 0-3, c 0-1, b 1-5, until 10");
  }

  TEST_CASE("of what repeats after years the first 300 activations are there, or so") {
    const std::string text = line_text(
        "graph: t\nplatform: {policy: table}\ntasks:\n"
        "  a: {type: Counter, period: 1ms, wcet: 1us}\n"
        "  b: {type: Counter, period: 100000007ns, wcet: 1us}\n");
    CHECK(text.ends_with("until 297"));
  }
}
