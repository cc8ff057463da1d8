// What the core on threads counts: periods, and rounds before the end.
#include <doctest/doctest.h>

#include "runtime/jarol/jarol_core.h"
#include "tests/runtime/at_some_speed.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::graph_of;

// A run in which no round was left out.
struct WholeRun {
  std::uint64_t rounds = 0, digest = 0;
  int times = 1;  // as slow as the text says
};

WholeRun run_whole(const std::string& text, Duration end) {
  WholeRun whole;
  CHECK(tests::at_some_speed([&](int times) {
    const Graph graph = graph_of(tests::slowed(text, times));
    JarolCore core(graph, {});
    core.run_for(times * end);
    const ThreadsReport& report = core.threads_report();
    whole = {report.rounds, core.report().digest, times};
    return report.unawaited_ticks == 0 && report.core_busy == 0;
  }));
  return whole;
}
}  // namespace

TEST_SUITE("runtime/jarol_core_rounds") {
  TEST_CASE(
      "LETs and offsets are ignored: tasks run once a period in data-flow order, and publish when they have run") {
    const auto text = [](const std::string& timing, const std::string& slow) {
      return "graph: t\ntasks:\n  z: {type: Counter, period: 5ms" + timing + "}\n  b: {type: Accumulate, period: 5ms" +
             timing + "}\n  a: {type: Sum, period: 10ms" + slow +
             "}\nconnections: [z.out -> b.in, b.out -> a.a, z.out -> a.b]\n";
    };
    const std::string timed = text(", let: 3ms, offset: 2ms", ", let: 10ms, offset: 7ms");
    const WholeRun whole = run_whole(timed, 48ms);
    CHECK(whole.rounds == 10);
    const auto digest_of_exotasks = [&](const std::string& of) {
      const Graph graph = graph_of(tests::slowed(of, whole.times));
      return tests::run_graph(graph, whole.times * 48ms).report.digest;
    };
    CHECK(whole.digest == digest_of_exotasks(text("", "")));
    CHECK(whole.digest != digest_of_exotasks(timed));
  }

  TEST_CASE("a run covers the rounds from 0 to before its end") {
    const std::string text = "{graph: t, tasks: {a: {type: Counter, period: 10ms}}}";
    CHECK(run_whole(text, 1ns).rounds == 1);
    CHECK(run_whole(text, 10ms).rounds == 1);
    CHECK(run_whole(text, 10ms + 1ns).rounds == 2);
    CHECK(run_whole(text, 30ms).rounds == 3);
  }
}
