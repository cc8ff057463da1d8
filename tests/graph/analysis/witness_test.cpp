#include "graph/analysis/witness.h"

#include <doctest/doctest.h>

#include "graph/analysis/check.h"
#include "graph/analysis/schedule.h"
#include "tests/graph/analysis/milliseconds.h"
#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;
using namespace jarol::analysis;

using tests::ms;

// The late activation of a set of tasks.
struct Late {
  std::string task;
  std::int64_t activation = -1;
  Duration release{-1}, finish{-1}, deadline{-1};
  bool ended = true;
  bool operator==(const Late&) const = default;
};

Late late_of(const std::string& policy, const std::string& rest) {
  const Graph graph = tests::graph_of("graph: t\nplatform: {policy: " + policy + "}\n" + rest);
  const Result result = check(graph);
  CHECK(result.verdict == Verdict::not_schedulable);
  if (!result.late) return {};
  const DeadlineMiss& m = *result.late;
  return {graph.tasks[m.task].name, m.activation, m.release, m.finish, m.deadline, m.ended};
}

const std::string starved = R"(tasks:
  hp: {type: Counter, period: 10ms, let: 10ms, wcet: 9ms}
  lp: {type: Counter, period: 100ms, let: 100ms, wcet: 50ms}
)";
}  // namespace

TEST_SUITE("graph/analysis/witness") {
  TEST_CASE("what goes before a late activation arrives until that has ended") {
    // a millisecond of each ten is left for it
    CHECK(late_of("fixed_priority", starved) == Late{"lp", 0, {}, 500 * ms, 100 * ms});
  }

  TEST_CASE("a late activation that never ends is late at the end of the run") {
    std::string full = starved;
    full.replace(full.find("9ms"), 3, "10ms");
    CHECK(late_of("fixed_priority", full) == Late{"lp", 0, {}, 182'010 * ms, 100 * ms, false});
  }

  TEST_CASE("what takes ten years is late before the time of an analysis is over") {
    const Late late = late_of("fixed_priority", R"(tasks:
  a: {type: Counter, period: 87600h, wcet: 87600h}
  b: {type: Counter, period: 87600h, wcet: 1ns}
)");
    CHECK(late == Late{"b", 0, {}, Duration(std::int64_t{1} << 62), 315'360'000'000 * ms, false});
  }

  TEST_CASE("a reader of a higher priority does not go before what it follows, and is what is late") {
    const std::string up = R"(tasks:
  p: {type: Counter, period: 10ms, wcet: 6ms}
  r: {type: Relay, period: 10ms, let: 10ms, wcet: 5ms, priority: 1}
connections: [p.out -> r.in]
)";
    for (const std::string policy : {"fixed_priority", "fixed_priority_nonpreemptive"}) {
      CAPTURE(policy);
      CHECK(late_of(policy, up) == Late{"r", 0, {}, 11 * ms, 10 * ms});
    }
  }

  TEST_CASE("who is late of random sets that are too much for a core is late as long when they run") {
    for (const std::string policy : {"fixed_priority", "edf", "fixed_priority_nonpreemptive", "edf_nonpreemptive"})
      for (std::uint64_t seed = 0; seed < 50; ++seed) {
        CAPTURE(policy);
        CAPTURE(seed);
        std::string tasks = "tasks:\n";
        for (std::uint64_t i = 0; i < 4; ++i)
          tasks += "  t" + std::to_string(i) +
                   ": {type: Counter, period: " + std::to_string(10 * (1 + (seed + i) % 4)) +
                   "ms, wcet: " + std::to_string(3 + (seed / 4 + 3 * i) % 5 + (i == 0 ? 4 : 0)) + "ms}\n";
        const Graph graph = tests::graph_of("graph: t\nplatform: {policy: " + policy + "}\n" + tasks);
        const System system = system_of(graph);
        const Result result = check(system);
        if (utilisation(system.models) <= 1 || !result.late || !result.late->ended) continue;
        const DeadlineMiss& late = *result.late;
        // no activation begins while one of its task runs, so that only the first of a task are the same
        if (late.activation > 0) continue;
        Schedule schedule(system, std::vector<std::size_t>(4, 0), std::vector<bool>(4, false),
                          [&](std::size_t task, std::int64_t) { return system.models[task].wcet; });
        const Fate& fate = schedule.fate(late.task, 0);
        CHECK(fate.kind == Fate::Kind::late);
        if (fate.response) CHECK(*fate.response == late.finish - late.release);
      }
  }
}
