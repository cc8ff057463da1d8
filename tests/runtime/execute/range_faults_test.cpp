// Outputs out of their ranges, of the tasks that are looked at cheapest.
#include <doctest/doctest.h>

#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Without a heap, and of nothing but doubles: what is looked at cheapest where it has a LET.
struct Bounded {
  static constexpr std::string_view summary = "for tests";
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    double angle = 0;
    static constexpr auto fields() { return describe(field<&Out::angle>("").in(-1, 1)); }
  };
  static void run(const Tick&, const In& in, Out& out) { out.angle = in.in; }
};

Graph graph_with(const std::string& keys) {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(task_class<Bounded>());
    return made;
  }();
  return tests::graph_of(registry, R"(graph: g
tasks:
  a: {type: Counter, period: 10ms}
  b: {type: Bounded, period: 10ms, )" + keys +
                                       R"(}
connections: [a.out -> b.in]
)");
}
}  // namespace

TEST_SUITE("runtime/range_faults") {
  TEST_CASE("a range is looked at also where a task has a LET, and whatever follows a fault") {
    for (const std::string timing : {"", ", let: 5ms"})
      for (const std::string policy : {"stop", "hold"}) {
        CAPTURE(policy + timing);
        const Graph graph = graph_with("on_fault: " + policy + timing);
        Executor executor(graph, {});
        executor.run_until(50ms);
        const Report& report = executor.report();
        REQUIRE(!report.faults.empty());
        CHECK(report.faults.at(0).activation == 2);
        CHECK(report.faults.at(0).cause == "output 'angle' is 2, out of its range from -1 to 1");
        CHECK(report.stopped == (policy == "stop"));
      }
  }
}
