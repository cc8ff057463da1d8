#include "tools/measure.h"

#include <doctest/doctest.h>

#include <stdexcept>

#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

std::string rewritten(const std::string& text, const std::vector<Duration>& wcets) {
  Problems problems;
  const auto source = std::make_shared<Source>(Source{"t.yaml", text});
  const GraphSpec spec = load_spec(source, {}, problems);
  problems.throw_if_any();
  return tools::with_wcets(text, spec, tests::graph_of(text), wcets);
}
}  // namespace

TEST_SUITE("tools/measure") {
  TEST_CASE("a margin comes on top, rounded up to three digits") {
    CHECK(tools::with_margin(1000ns, 0.2) == 1200ns);
    CHECK(tools::with_margin(12'345ns, 0) == 12'400ns);
    CHECK(tools::with_margin(999ns, 0) == 999ns);
    CHECK(tools::with_margin(0ns, 0.2) == 1ns);
  }

  TEST_CASE("WCETs are written into a file, and its comments and layout stay") {
    CHECK(rewritten(R"(graph: t  # a comment
timing: {period: 10ms}
tasks:
  b: {type: Relay, let: 5ms, wcet: 1ms}   # keep me
  a: { type: Counter }

  c:
    # above
    type: Counter   # behind
    period: 5ms
  d:
    wcet: '3ms'
    type: Counter
connections: [a.out -> b.in]
)",
                    {1us, 2us, 3500ns, 4us}) == R"(graph: t  # a comment
timing: {period: 10ms}
tasks:
  b: {type: Relay, let: 5ms, wcet: 2us}   # keep me
  a: { type: Counter, wcet: 1us }

  c:
    # above
    type: Counter
    wcet: 3.5us   # behind
    period: 5ms
  d:
    wcet: 4us
    type: Counter
connections: [a.out -> b.in]
)");
  }

  TEST_CASE("tasks that share one place of the file are not edited") {
    CHECK_THROWS_WITH_AS(rewritten("graph: t\ntasks:\n  a: &one {type: Counter, period: 1ms}\n  b: *one\n", {1us, 1us}),
                         "two tasks share one place of the file through an alias; write their 'wcet' yourself",
                         std::invalid_argument);
  }

  TEST_CASE("every activation of every task is measured") {
    tools::Loaded loaded = tools::load_graph("specs/counting.yaml", {});
    const auto measured = tools::measure_tasks(loaded, 1s);
    REQUIRE(measured.size() == 5);
    const std::vector<std::size_t> activations{50, 100, 20, 50, 50};
    for (std::size_t i = 0; i < measured.size(); ++i) {
      CHECK(measured[i].activations == activations[i]);
      CHECK(measured[i].most >= measured[i].most_of_999);
      CHECK(measured[i].most_of_999 > 0ns);
    }
  }
}
