#include "runtime/threads_core.h"

#include <doctest/doctest.h>

#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::graph_of;

constexpr const char* counting =
    "graph: t\ntasks:\n  c: {type: Counter, period: 10ms}\n  half: {type: Counter, period: 20ms}\n"
    "  s: {type: Sum, period: 10ms}\nconnections: [c.out -> s.a, half.out -> s.b]\n";
}  // namespace

TEST_SUITE("runtime/threads_core") {
  TEST_CASE("the core runs each task that is due by counting rounds, once, in data-flow order") {
    const Graph graph = graph_of(counting);
    ThreadsCore core(graph, {});
    CHECK(core.period() == 10ms);
    core.run_for(250ms);
    const std::uint64_t rounds = core.threads_report().rounds;
    CHECK(rounds > 0);
    CHECK(rounds <= 26);
    // a busy machine may leave out rounds, also those in which the slow task was due
    CHECK(core.report().activations >= 2 * rounds);
    CHECK(core.report().activations <= 2 * rounds + rounds / 2 + 1);
    CHECK(core.threads_report().round.count() == rounds);
    CHECK(core.report().fault_count == 0);
  }

  TEST_CASE("undisturbed it has the digest of a data-flow graph as exotasks") {
    const Graph graph = graph_of(counting);
    Executor executor(graph, {});
    bool same = false;
    for (int attempt = 0; attempt < 50 && !same; ++attempt) {
      ThreadsCore core(graph, {});
      core.run_for(95ms);
      if (core.threads_report().rounds != 10 || core.threads_report().core_busy > 0) continue;
      if (executor.now() == 0ms) executor.run_until(100ms);
      same = core.report().digest == executor.report().digest;
      CHECK(same);
    }
    CHECK(same);
  }

  TEST_CASE("periods that can't be counted in those of the sensor thread are refused") {
    const Graph graph =
        graph_of("graph: t\ntasks: {a: {type: Counter, period: 10ms}, b: {type: Counter, period: 15ms}}\n");
    CHECK_THROWS_WITH_AS(
        ThreadsCore(graph, {}),
        "threads count in periods of the vehicle's channels, 10ms; task 'b' has 15ms, which is no multiple of it",
        std::invalid_argument);
  }

  TEST_CASE("an interrupt ends it") {
    const Graph graph = graph_of(counting);
    ThreadsCore core(graph, {});
    std::thread other([&] {
      std::this_thread::sleep_for(30ms);
      core.interrupt();
    });
    core.run_for(1h);
    other.join();
    CHECK(core.threads_report().rounds < 1000);
  }
}
