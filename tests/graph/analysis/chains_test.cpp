#include "graph/analysis/chains.h"

#include <doctest/doctest.h>

#include "tests/graph/analysis/milliseconds.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace jarol::analysis;

using tests::ms;

std::string task_name(std::size_t i) { return (i < 10 ? "t0" : "t") + std::to_string(i); }

// A chain of LET tasks whose LETs are their periods.
Graph let_chain(const std::vector<int>& periods) {
  std::string tasks, connections;
  for (std::size_t i = 0; i < periods.size(); ++i) {
    const std::string p = std::to_string(periods[i]) + "ms";
    tasks +=
        "  " + task_name(i) + ": {type: " + (i == 0 ? "Counter" : "Relay") + ", period: " + p + ", let: " + p + "}\n";
    if (i > 0) connections += "  - " + task_name(i - 1) + ".out -> " + task_name(i) + ".in\n";
  }
  return tests::graph_of("graph: t\ntasks:\n" + tasks + "connections:\n" + connections);
}

std::vector<End> all_tasks(const Graph& graph) {
  std::vector<End> path;
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) path.push_back({End::Kind::task, i, 0});
  return path;
}

// Whatever it takes.
ChainLatency exact_latency(const Graph& graph, const std::vector<End>& path) {
  Budget budget;
  return latency_of(graph, path, budget);
}
}  // namespace

TEST_SUITE("graph/analysis/chains") {
  TEST_CASE("the published chains come out exactly") {
    struct Published {
      std::vector<int> periods;
      std::int64_t max_reaction, reduced, min_reaction;  // ms
    };
    // effect chains of WATERS 2016/17 and 2019, RTSS 2021, JSA 2024, Gemlau 2021, Frey 2010 and ROSACE
    const std::vector<Published> all{{{10, 10, 10, 10}, 50, 40, 40},
                                     {{33, 400, 15, 15, 5}, 908, 875, 470},
                                     {{10, 15, 15, 5}, 65, 55, 45},
                                     {{66, 15, 5}, 164, 98, 86},
                                     {{100, 100, 100, 100, 100, 10}, 610, 510, 510},
                                     {{100, 100, 100, 100, 100, 100, 10}, 710, 610, 610},
                                     {{10, 100, 100, 10}, 320, 310, 220},
                                     {{20, 30, 40, 50, 60}, 360, 340, 240},
                                     {{5, 10, 2, 1, 2}, 31, 26, 21},
                                     {{5, 10, 10, 10}, 45, 40, 35},
                                     {{5, 10, 10, 10, 10}, 55, 50, 45},
                                     {{10, 20, 20}, 70, 60, 50}};
    for (const Published& p : all) {
      CAPTURE(p.periods.size());
      CAPTURE(p.periods[0]);
      const Graph graph = let_chain(p.periods);
      const ChainLatency l = exact_latency(graph, all_tasks(graph));
      CHECK(l.max_reaction == p.max_reaction * ms);
      CHECK(l.max_age == p.max_reaction * ms);  // forward and backward agree
      CHECK(l.max_reduced == p.reduced * ms);
      CHECK(l.min_reaction == p.min_reaction * ms);
    }
  }

  TEST_CASE("a chain through communicators and data-flow tasks counts the order inside an instant") {
    const Graph graph = tests::graph_of(R"(graph: t
timing: {period: 10ms}
communicators:
  i: {type: double, direction: in}
  late: {type: double, direction: out}
  soon: {type: double, direction: out, offset: 2ms}
tasks:
  a: {type: Relay}
  b: {type: Relay}
connections: [i -> a.in, a.out -> b.in, b.out -> late, a.out -> soon]
chains:
  slow: {path: [i, a, b, late], reaction: 30ms, age: 15ms}
  fast: {path: [i, a, soon]}
)");
    REQUIRE(graph.chains.size() == 2);
    CHECK(graph.chains[1].name == "slow");
    const ChainLatency fast = exact_latency(graph, graph.chains[0].path),
                       slow = exact_latency(graph, graph.chains[1].path);
    CHECK(fast.max_reaction == 12 * ms);
    CHECK(fast.min_reaction == 2 * ms);
    CHECK(slow.max_reaction == 20 * ms);  // what is published at an instant is handed over at the next
    CHECK(slow.min_reaction == 10 * ms);
    CHECK(slow.at == std::vector<Duration>{50 * ms, 50 * ms, 50 * ms, 50 * ms, 60 * ms});
  }

  TEST_CASE("a chain that repeats too late to be enumerated has the classical upper bound") {
    const Graph graph = let_chain({9973, 9967, 9949, 9941, 9931});
    const ChainLatency l = exact_latency(graph, all_tasks(graph));
    CHECK_FALSE(l.exact);
    CHECK(l.max_reaction == 2 * (9973 + 9967 + 9949 + 9941 + 9931) * ms);
  }

  TEST_CASE("a chain whose repetition reaches beyond all time has the upper bound, too") {
    std::string tasks, connections;
    for (std::size_t i = 0; i < 16; ++i) {
      tasks += "  " + task_name(i) + ": {type: " + (i == 0 ? "Counter" : "Relay") +
               ", period: 315000000s, offset: 314000000s, let: 315000000s}\n";
      if (i > 0) connections += "  - " + task_name(i - 1) + ".out -> " + task_name(i) + ".in\n";
    }
    const Graph graph = tests::graph_of("graph: t\ntasks:\n" + tasks + "connections:\n" + connections);
    constexpr Duration period = std::chrono::seconds(315'000'000);
    std::vector<End> path = all_tasks(graph);
    const ChainLatency all = exact_latency(graph, path);
    CHECK_FALSE(all.exact);
    CHECK(all.max_age == Duration::max());
    path.resize(5);
    const ChainLatency five = exact_latency(graph, path);
    CHECK_FALSE(five.exact);
    CHECK(five.max_reaction == 10 * period);
    CHECK(five.max_age == 10 * period);
    path.resize(3);
    const ChainLatency three = exact_latency(graph, path);
    CHECK(three.exact);
    CHECK(three.max_reaction == 4 * period);
  }

  TEST_CASE("each hop of each activation of a repetition is a step, and without as many left a latency is a bound") {
    const Graph graph = let_chain({10, 20, 40});
    // 4 reads and 1 output, each through 3 hops
    Budget enough{15}, scarce{14};
    const ChainLatency exact = latency_of(graph, all_tasks(graph), enough);
    CHECK(exact.exact);
    CHECK(exact.max_reaction == 110 * ms);
    CHECK(enough.left == 0);
    const ChainLatency bound = latency_of(graph, all_tasks(graph), scarce);
    CHECK_FALSE(bound.exact);
    CHECK(bound.max_reaction == 140 * ms);
    CHECK(bound.max_age == 140 * ms);
    CHECK(scarce.left == 14);
  }
}
