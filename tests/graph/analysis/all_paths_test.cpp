#include "graph/analysis/all_paths.h"

#include <doctest/doctest.h>

#include <string>

#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;

const std::string from_in_to_out =
    "graph: t\ntiming: {period: 10ms}\ncommunicators:\n  i: {type: double, direction: in}\n"
    "  o: {type: double, direction: out}\n";

Graph built_of(const std::string& tasks, const std::string& connections) {
  return tests::graph_of(from_in_to_out + "tasks:\n" + tasks + "connections:\n" + connections);
}

std::vector<std::string> names_of(const Graph& graph, const std::vector<End>& path) {
  std::vector<std::string> names;
  for (const End& end : path)
    names.push_back(end.kind == End::Kind::task ? graph.tasks[end.index].name : graph.communicators[end.index].name);
  return names;
}
}  // namespace

TEST_SUITE("graph/all_paths") {
  TEST_CASE("each path from an in to an out is found once, in the order of the connections, and no task twice in it") {
    const Graph graph =
        built_of("  a: {type: Sum, let: 10ms}\n  b: {type: Sum, let: 10ms}\n  c: {type: Relay}\n",
                 "  - a.out -> b.a\n  - a.out -> b.b\n  - i -> a.a\n  - b.out -> a.b\n  - i -> c.in\n  - b.out -> o\n");
    const analysis::AllPaths all = analysis::all_paths(graph);
    REQUIRE(all.paths.size() == 1);
    CHECK(names_of(graph, all.paths[0]) == std::vector<std::string>{"i", "a", "b", "o"});
    CHECK_FALSE(all.more);
  }

  TEST_CASE("a path through 20,000 tasks is found") {
    constexpr std::size_t count = 20'000;
    std::string tasks, connections = "  - i -> t0.in\n";
    for (std::size_t k = 0; k < count; ++k) {
      const std::string name = "t" + std::to_string(k);
      tasks += "  " + name + ": {type: Relay}\n";
      connections += "  - " + name + ".out -> " + (k + 1 < count ? "t" + std::to_string(k + 1) + ".in" : "o") + "\n";
    }
    const analysis::AllPaths all = analysis::all_paths(built_of(tasks, connections));
    REQUIRE(all.paths.size() == 1);
    CHECK(all.paths[0].size() == count + 2);
    CHECK_FALSE(all.more);
  }

  TEST_CASE("where ways that lead back to their beginning are more than anyone can walk, the search ends and says so") {
    std::string tasks = "  a: {type: Sum, let: 10ms}\n", connections = "  - i -> a.a\n  - a.out -> o\n";
    constexpr int rungs = 60;
    for (int k = 0; k < rungs; ++k)
      for (const std::string side : {"x", "y"}) {
        const std::string name = side + std::to_string(k), below = std::to_string(k - 1);
        tasks += "  " + name + ": {type: Sum, let: 10ms}\n";
        connections += "  - " + (k == 0 ? "a" : "x" + below) + ".out -> " + name + ".a\n  - " +
                       (k == 0 ? "a" : "y" + below) + ".out -> " + name + ".b\n";
      }
    const Graph graph = built_of(tasks, connections + "  - x" + std::to_string(rungs - 1) + ".out -> a.b\n");
    const analysis::AllPaths all = analysis::all_paths(graph);
    REQUIRE(all.paths.size() == 1);
    CHECK(names_of(graph, all.paths[0]) == std::vector<std::string>{"i", "a", "o"});
    CHECK_FALSE(all.more);
    CHECK_FALSE(all.whole);
  }
}
