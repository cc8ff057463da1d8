#include "runtime/machine/thread_time.h"

#include <doctest/doctest.h>

#include <thread>

#include "tests/graph/graph_of.h"

#include "runtime/execute/executor.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Is kept from running for 5 ms, as by a thread that preempts it.
struct Held {
  static constexpr std::string_view summary = "for tests";
  static void run(const Tick&) { std::this_thread::sleep_for(5ms); }
};

Histogram measured(const Graph& graph, Duration end) {
  Executor executor(graph, {}, {.digest = false, .sharing = Sharing::measure});
  executor.run_until(end);
  return executor.team()->took(0);
}
}  // namespace

TEST_SUITE("runtime/thread_time") {
  TEST_CASE("a thread's time goes on while it runs and stands still while it does not") {
    const Duration before = thread_time();
    std::this_thread::sleep_for(20ms);
    const Duration asleep = thread_time() - before;
    CHECK(asleep > 0ns);
    CHECK(asleep < 10ms);
    CHECK(thread_time_between_readings() > 0ns);
    CHECK(thread_time_between_readings() < 100us);
  }

  TEST_CASE("what keeps a task from running is not measured") {
    Registry registry;
    registry.add(task_class<Held>());
    const Histogram took =
        measured(tests::graph_of(registry, "graph: t\ntasks: {a: {type: Held, period: 1ms}}\n"), 10ms);
    CHECK(took.count() == 10);
    CHECK(took.percentile(0) > 0ns);
    CHECK(took.percentile(0.5) < 2ms);
  }

  TEST_CASE("what a task takes itself is measured in full") {
    const auto min = [](int rounds) {
      const Graph graph = tests::graph_of(
          "graph: t\ntasks: {a: {type: Work, period: 1ms, parameters: {rounds: " + std::to_string(rounds) + "}}}\n");
      return static_cast<double>(measured(graph, 50ms).percentile(0).count());
    };
    // again where the machine became quicker or slower meanwhile
    double ratio = 0;
    for (int attempt = 0; attempt < 20 && (ratio < 7 || ratio > 14); ++attempt) ratio = min(100'000) / min(10'000);
    CHECK(ratio >= 7);
    CHECK(ratio <= 14);
  }
}
