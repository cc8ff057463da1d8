#include "runtime/jarol/threads_order.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>

#include "tests/graph/graph_of.h"
#include "tests/runtime/random_model.h"

namespace {
using namespace jarol;

// Names in the order in which threads run them; in capitals those with a LET.
std::string order_of(const std::string& tasks, const std::string& connections) {
  std::string text = "graph: t\ntiming: {period: 10ms}\ntasks:\n";
  for (const char task : tasks) {
    const bool let = task >= 'A' && task <= 'Z';
    text += std::string("  ") + task + ": {type: Sum" + (let ? ", let: 10ms" : "") + "}\n";
  }
  text += "communicators: {zero: {type: double, direction: in}}\nconnections:\n";
  std::string open;  // inputs that nobody feeds yet
  for (const char task : tasks) open += std::string(1, task) + "a" + std::string(1, task) + "b";
  for (std::size_t i = 0; i + 1 < connections.size(); i += 3) {
    std::size_t at = open.find(std::string(1, connections[i + 1]) + "a");
    if (at == std::string::npos) at = open.find(std::string(1, connections[i + 1]) + "b");
    text += std::string("  - ") + connections[i] + ".out -> " + open[at] + "." + open[at + 1] + "\n";
    open.erase(at, 2);
  }
  for (std::size_t i = 0; i < open.size(); i += 2)
    text += std::string("  - zero -> ") + open[i] + "." + open[i + 1] + "\n";
  const Graph graph = tests::graph_of(text);
  std::string order;
  for (const std::size_t i : threads_order(graph)) order += graph.tasks[i].name;
  return order;
}
}  // namespace

TEST_SUITE("runtime/threads_order") {
  TEST_CASE("a task follows those that feed it, with a LET or without; else names decide") {
    CHECK(order_of("abc", "") == "abc");
    CHECK(order_of("abc", "cb ba") == "cba");
    CHECK(order_of("aBC", "CB Ba") == "CBa");
    CHECK(order_of("aBcD", "Da") == "BDac");
  }

  TEST_CASE("a cycle is entered where only LET tasks feed it, not at what hangs on it, be it a cycle too") {
    CHECK(order_of("A", "AA") == "A");
    CHECK(order_of("abX", "Xb bX Xa") == "bXa");
    CHECK(order_of("aXY", "XY YX Xa") == "XYa");
    CHECK(order_of("aXYb", "XY YX Xa ab bX") == "abXY");
    CHECK(order_of("aXyZw", "aX Xy ya Zw wZ Zy") == "wZyaX");
  }

  TEST_CASE("a thousand cycles, each fed by the one before it, take no time to speak of") {
    constexpr std::size_t cycles = 1000;
    // names run against the flow, so that the last cycle is the first to be looked at
    const auto name = [&](std::size_t cycle) { return std::to_string(10'000 + cycles - cycle); };
    std::string text = "graph: t\ntiming: {period: 10ms}\ntasks:\n", connections = "connections:\n";
    for (std::size_t i = 0; i < cycles; ++i) {
      text += "  a" + name(i) + ": {type: Sum}\n  b" + name(i) + ": {type: Sum, let: 10ms}\n";
      connections += "  - a" + name(i) + ".out -> b" + name(i) + ".a\n  - b" + name(i) + ".out -> a" + name(i) +
                     ".a\n  - " + (i == 0 ? "zero" : "b" + name(i - 1) + ".out") + " -> a" + name(i) +
                     ".b\n  - zero -> b" + name(i) + ".b\n";
    }
    const Graph graph = tests::graph_of(text + "communicators: {zero: {type: double, direction: in}}\n" + connections);
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<std::size_t> order = threads_order(graph);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(5));
    REQUIRE(order.size() == 2 * cycles);
    for (std::size_t i = 0; i < cycles; ++i) {
      CHECK(graph.tasks[order[2 * i]].name == "a" + name(i));
      CHECK(graph.tasks[order[2 * i + 1]].name == "b" + name(i));
    }
  }

  TEST_CASE("in random graphs each task has its turn, after all that feed it without a LET") {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
      const Graph graph = tests::graph_of(oracle::to_yaml(oracle::random_model(seed), seed));
      const std::vector<std::size_t> order = threads_order(graph);
      REQUIRE(order.size() == graph.tasks.size());
      const auto turn = [&](std::size_t task) { return std::find(order.begin(), order.end(), task); };
      for (std::size_t i = 0; i < graph.tasks.size(); ++i) REQUIRE(turn(i) != order.end());
      for (const Connection& c : graph.connections)
        if (c.from.kind == End::Kind::task && c.to.kind == End::Kind::task && !graph.tasks[c.from.index].let)
          REQUIRE(turn(c.from.index) < turn(c.to.index));
    }
  }
}
