// The order of tasks that are released together, where it is remembered and where there is no room for it.
#include "runtime/dispatch/rows.h"

#include <doctest/doctest.h>

#include "runtime/execute/executor.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Sums in a chain, each of the next period, so that every one stands in a stage after the one before.
std::string chain_of(const std::vector<int>& periods, int length) {
  std::string tasks = "  t1000: {type: Counter, period: 1ms}\n", connections;
  for (int i = 1; i < length; ++i) {
    const std::string name = "t" + std::to_string(1000 + i), before = "t" + std::to_string(999 + i);
    tasks += "  " + name +
             ": {type: Sum, period: " + std::to_string(periods[static_cast<std::size_t>(i) % periods.size()]) + "ms}\n";
    connections += "  - " + before + ".out -> " + name + ".a\n  - t1000.out -> " + name + ".b\n";
  }
  for (std::size_t i = 0; i < periods.size(); ++i)  // whose outputs tell which release of its group it is
    tasks += "  u" + std::to_string(100 + i) + ": {type: Counter, period: " + std::to_string(periods[i]) + "ms}\n";
  return "graph: t\ntasks:\n" + tasks + "connections:\n" + connections;
}

std::vector<int> up_to(int last) {
  std::vector<int> periods;
  for (int period = 1; period <= last; ++period) periods.push_back(period);
  return periods;
}

struct EndOfRun {
  std::uint64_t digest, activations;
  friend bool operator==(const EndOfRun&, const EndOfRun&) = default;
};

EndOfRun end_of(const Graph& graph, const ExecutorOptions& options) {
  Executor run(graph, {}, options);
  run.run_until(500ms);
  return {run.report().digest, run.report().activations};
}

// Each stage of its own, one after the other.
EndOfRun end_by_stages(const Graph& graph) { return end_of(graph, {.workers = 2, .sharing = Sharing::always}); }

// How often the groups of a plan are merged if each of these sets is due in turn, twice.
int merges(const std::vector<std::vector<std::uint32_t>>& sets, const Plan& plan) {
  Rows rows(plan, true);
  int merges = 0;
  for (int round = 0; round < 2; ++round)
    for (const auto& due : sets)
      (void)rows.of(due, [&](auto add) {
        ++merges;
        for (std::uint32_t i = 0; i < due.size(); ++i)
          for (const Plan::Segment& segment : plan.segments_of(plan.groups[due[i]])) add(segment.tasks, i);
      });
  return merges;
}
}  // namespace

TEST_SUITE("runtime/rows") {
  TEST_CASE("a set of groups that is due again is not merged again") {
    const Graph graph = tests::graph_of(chain_of({1, 2, 5}, 30));
    CHECK(merges({{0, 1}, {0, 1, 2}, {0, 2}}, Plan(graph)) == 3);
  }

  TEST_CASE("of more than 64 groups nothing is remembered") {
    const Graph graph = tests::graph_of(chain_of(up_to(65), 130));
    CHECK(merges({{0, 1}, {0, 1, 2}, {0, 2}}, Plan(graph)) == 6);
  }

  TEST_CASE("tasks of one group that follow each other are one row") {
    const Graph graph = tests::graph_of(chain_of({1, 2}, 9));
    const Plan plan(graph);
    Rows rows(plan, true);
    const std::vector<std::uint32_t> due{0, 1};
    const Indices first{0, 2}, second{2, 1}, other{3, 3};
    const auto merged = rows.of(due, [&](auto add) {
      add(first, 0);
      add(second, 0);
      add(other, 1);
    });
    REQUIRE(merged.size() == 2);
    CHECK(merged[0].tasks.first == 0);
    CHECK(merged[0].tasks.count == 3);
    CHECK(merged[0].due == 0);
    CHECK(merged[1].tasks.first == 3);
    CHECK(merged[1].tasks.count == 3);
    CHECK(merged[1].due == 1);
  }

  TEST_CASE("the order is that of the stages, whatever of it is remembered") {
    for (const auto& [periods, length] :
         {std::pair(std::vector<int>{1, 2, 5, 10}, 100),                // few sets: all of it
          std::pair(std::vector<int>{1, 2, 3, 5, 7, 11, 13, 17}, 100),  // more sets than have a place
          std::pair(up_to(70), 140),                                    // too many groups
          std::pair(std::vector<int>{1, 2, 3, 5, 7, 11}, 1200)}) {      // more rows than there is room for
      const std::size_t count = periods.size();
      CAPTURE(count);
      const Graph graph = tests::graph_of(chain_of(periods, length));
      CHECK(end_of(graph, {}) == end_by_stages(graph));
    }
  }
}
