// What the core on threads counts: periods, and rounds before the end.
#include <doctest/doctest.h>

#include "runtime/threads_core.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::graph_of;

// The digest of a run in which no round was left out; 0 where the machine kept none.
std::uint64_t undisturbed_digest(const Graph& graph, Duration end, std::uint64_t rounds) {
  for (int attempt = 0; attempt < 50; ++attempt) {
    ThreadsCore core(graph, {});
    core.run_for(end);
    if (core.threads_report().rounds == rounds) return core.report().digest;
  }
  return 0;
}

// The rounds of a run in which none was left out; 0 where the machine kept none.
std::uint64_t rounds_before(const Graph& graph, Duration end) {
  for (int attempt = 0; attempt < 50; ++attempt) {
    ThreadsCore core(graph, {});
    core.run_for(end);
    const ThreadsReport& report = core.threads_report();
    if (report.unawaited_ticks == 0 && report.core_busy == 0) return report.rounds;
  }
  return 0;
}
}  // namespace

TEST_SUITE("runtime/threads_core_rounds") {
  TEST_CASE(
      "LETs and offsets are ignored: tasks run once a period in data-flow order, and publish when they have run") {
    const auto graph = [](const std::string& timing, const std::string& slow) {
      return graph_of("graph: t\ntasks:\n  z: {type: Counter, period: 5ms" + timing +
                      "}\n  b: {type: Accumulate, period: 5ms" + timing + "}\n  a: {type: Sum, period: 10ms" + slow +
                      "}\nconnections: [z.out -> b.in, b.out -> a.a, z.out -> a.b]\n");
    };
    const Graph timed = graph(", let: 3ms, offset: 2ms", ", let: 10ms, offset: 7ms");
    Executor plain(graph("", ""), {});
    plain.run_until(48ms);
    CHECK(undisturbed_digest(timed, 48ms, 10) == plain.report().digest);
    Executor exotasks(timed, {});
    exotasks.run_until(48ms);
    CHECK(exotasks.report().digest != plain.report().digest);
  }

  TEST_CASE("a run covers the rounds from 0 to before its end") {
    const Graph graph = graph_of("{graph: t, tasks: {a: {type: Counter, period: 10ms}}}");
    CHECK(rounds_before(graph, 1ns) == 1);
    CHECK(rounds_before(graph, 10ms) == 1);
    CHECK(rounds_before(graph, 10ms + 1ns) == 2);
    CHECK(rounds_before(graph, 30ms) == 3);
  }
}
