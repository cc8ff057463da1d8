#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;
using tests::lines_of;

// Counts its activations; from `first` on throws or publishes NaN, `count` times.
struct Fails {
  static constexpr std::string_view summary = "for tests";
  struct Param {
    std::int64_t first = 2;
    std::int64_t count = 1;
    bool nan = false;
    static constexpr auto fields() {
      return describe(field<&Param::first>(), field<&Param::count>(), field<&Param::nan>());
    }
  };
  struct State {
    double runs = 0;
    static constexpr auto fields() { return describe(field<&State::runs>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Param& p, const Tick& tick, State& state, Out& out) {
    state.runs += 1;
    out.out = state.runs;
    if (tick.activation < p.first || tick.activation >= p.first + p.count) return;
    if (!p.nan) throw std::runtime_error("too hot");
    out.out = std::numeric_limits<double>::quiet_NaN();
  }
};

// Adds one to each of its outputs where they lie, and throws at its third activation after it did.
struct Counts {
  static constexpr std::string_view summary = "for tests";
  struct State {
    double first = 0;
    double last = 0;
    static constexpr auto fields() { return describe(field<&State::first>(), field<&State::last>()); }
  };
  struct Out {
    double seen = 0;
    double first = 0;
    double second = 0;
    double third = 0;
    static constexpr auto fields() {
      return describe(field<&Out::seen>("", "in the state"), field<&Out::first>(), field<&Out::second>(),
                      field<&Out::third>());
    }
  };
  static void run(const Tick& tick, State& state, Out& out) {
    state.first += 1;
    state.last += 1;
    out.seen = state.first == state.last ? state.last : -1;
    out.first += 1;
    out.second += 1;
    out.third += 1;
    if (tick.activation == 2) throw std::runtime_error("too hot");
  }
};

tests::Run run(const std::string& task, Duration end) {
  static const Registry registry = [] {
    Registry made;
    tasks::add_tasks(made);
    made.add(task_class<Fails>());
    return made;
  }();
  const std::string text = "graph: t\ntiming: {period: 10ms}\ntasks:\n  f: {type: Fails" + task +
                           "}\n  r: {type: Relay}\nconnections: [f.out -> r.in]\n";
  const Graph graph = tests::graph_of(registry, text);
  return tests::run_graph(graph, end);
}
}  // namespace

TEST_SUITE("runtime/faults") {
  TEST_CASE(
      "a task that throws stops the run at the end of that instant, reported with task, activation, instant and "
      "cause") {
    const auto r = run("", 100ms);
    CHECK(r.report.stopped);
    REQUIRE(r.report.faults.size() == 1);
    CHECK(to_text(r.report.faults[0]) == "task 'f' activation 2 at 0.02 s: threw: too hot");
    CHECK(lines_of(r, "f.out") == "0ns f.out=1; 10ms f.out=2");
    CHECK(lines_of(r, "r.out") == "0ns r.out=1; 10ms r.out=2; 20ms r.out=2");  // the instant is completed
    CHECK(r.report.simulated == 20ms);
  }

  TEST_CASE("a number that is not finite is a fault that names the output") {
    const auto r = run(", parameters: {nan: true}", 100ms);
    REQUIRE(r.report.faults.size() == 1);
    CHECK(to_text(r.report.faults[0]) == "task 'f' activation 2 at 0.02 s: output 'out' is nan");
    CHECK(lines_of(r, "f.out") == "0ns f.out=1; 10ms f.out=2");
  }

  TEST_CASE("a LET task's fault shows when its outputs would have") {
    const auto r = run(", let: 5ms", 100ms);
    REQUIRE(r.report.faults.size() == 1);
    CHECK(to_text(r.report.faults[0]) == "task 'f' activation 2 at 0.025 s: threw: too hot");
    CHECK(lines_of(r, "f.out") == "5ms f.out=1; 15ms f.out=2");
    CHECK(r.report.simulated == 25ms);
  }

  TEST_CASE("hold goes on: readers keep the last value and the state is as before the activation") {
    const auto r = run(", on_fault: hold", 50ms);
    CHECK_FALSE(r.report.stopped);
    CHECK(r.report.fault_count == 1);
    CHECK(lines_of(r, "f.out") == "0ns f.out=1; 10ms f.out=2; 30ms f.out=3; 40ms f.out=4");
    CHECK(lines_of(r, "r.out") == "0ns r.out=1; 10ms r.out=2; 20ms r.out=2; 30ms r.out=3; 40ms r.out=4");
    CHECK(r.report.activations == 10);
    CHECK(r.report.left_out == std::vector<std::uint64_t>{1, 0});
  }

  TEST_CASE("hold with a LET equal to the period") {
    const auto r = run(", on_fault: hold, let: 10ms", 60ms);
    REQUIRE(r.report.faults.size() == 1);
    CHECK(to_text(r.report.faults[0]) == "task 'f' activation 2 at 0.03 s: threw: too hot");
    CHECK(lines_of(r, "f.out") == "10ms f.out=1; 20ms f.out=2; 40ms f.out=3; 50ms f.out=4");
  }

  TEST_CASE("skip also leaves out the next activation") {
    const auto r = run(", on_fault: skip", 60ms);
    CHECK(r.report.fault_count == 1);
    CHECK(lines_of(r, "f.out") == "0ns f.out=1; 10ms f.out=2; 40ms f.out=3; 50ms f.out=4");
    CHECK(r.report.activations == 11);  // six of r, five of f
    CHECK(r.report.left_out == std::vector<std::uint64_t>{2, 0});
  }

  TEST_CASE("skip with a LET") {
    const auto r = run(", on_fault: skip, let: 5ms", 60ms);
    CHECK(r.report.fault_count == 1);
    CHECK(lines_of(r, "f.out") == "5ms f.out=1; 15ms f.out=2; 45ms f.out=3; 55ms f.out=4");
  }

  TEST_CASE("skip with a LET equal to the period") {
    const auto r = run(", on_fault: skip, let: 10ms", 60ms);
    REQUIRE(r.report.faults.size() == 1);
    CHECK(to_text(r.report.faults[0]) == "task 'f' activation 2 at 0.03 s: threw: too hot");
    CHECK(lines_of(r, "f.out") == "10ms f.out=1; 20ms f.out=2; 50ms f.out=3");
  }

  TEST_CASE("what was left out after a fault is no fault; the activation after it runs, and may be one again") {
    for (const std::string let : {"", ", let: 10ms"}) {
      const auto r = run(", on_fault: skip, parameters: {count: 4}" + let, 90ms);
      std::string faulty;
      for (const Fault& fault : r.report.faults) faulty += std::to_string(fault.activation) + " ";
      CHECK(faulty == "2 4 ");
      CHECK(r.report.left_out == std::vector<std::uint64_t>{4, 0});
      CHECK(lines_of(r, "f.out") == (let.empty() ? "0ns f.out=1; 10ms f.out=2; 60ms f.out=3; 70ms f.out=4; 80ms f.out=5"
                                                 : "10ms f.out=1; 20ms f.out=2; 70ms f.out=3; 80ms f.out=4"));
    }
  }

  TEST_CASE("stop completes the instant at which the fault shows, whatever is due at it, and nothing after it") {
    const auto r = run(R"(, let: 5ms}
  other: {type: Counter, period: 5ms}
  before: {type: Fails, let: 5ms, parameters: {first: -1}}
  zlast: {type: Counter, period: 5ms, let: 5ms)",
                       100ms);
    CHECK(r.report.stopped);
    CHECK(r.report.simulated == 25ms);
    CHECK(lines_of(r, "f.out") == "5ms f.out=1; 15ms f.out=2");
    CHECK(lines_of(r, "before.out") == "5ms before.out=1; 15ms before.out=2; 25ms before.out=3");
    CHECK(r.lines.back() == "25ms other.out=5");
    CHECK(lines_of(r, "zlast.out").ends_with("; 25ms zlast.out=4"));
  }

  TEST_CASE("after a fault every word of state and outputs is as it was before the activation") {
    struct Registered {
      Registry registry;
      Registered() {
        tasks::add_tasks(registry);
        registry.add(task_class<Counts>());
      }
    };
    static const Registered known;
    for (const std::string mode : {"hold", "skip"})
      for (const std::string let : {"", ", let: 5ms"}) {
        const Graph graph = tests::graph_of(
            known.registry,
            "graph: t\ntiming: {period: 10ms}\ntasks:\n  c: {type: Counts, on_fault: " + mode + let + "}\n");
        const auto r = tests::run_graph(graph, 60ms);
        REQUIRE(r.report.fault_count == 1);
        // each activation adds one to what it finds; the faulty one left nothing, the one that was skipped neither
        const std::string last = mode == "hold" ? "5" : "4";
        const std::string at = let.empty() ? "50ms" : "55ms";
        for (const std::string output : {"c.first", "c.second", "c.third"})
          CHECK(lines_of(r, output).ends_with(at + " " + output + "=" + last));
        CHECK(lines_of(r, "c.seen").ends_with(at + " c.seen=" + last));
      }
  }

  TEST_CASE("only tasks that declare hold or skip pay for a copy of their state") {
    const Graph graph = tests::graph_of(R"(graph: t
timing: {period: 10ms}
communicators: {i: {type: double, direction: in}}
tasks:
  h: {type: Accumulate, on_fault: hold}
  s: {type: Accumulate, on_fault: skip, let: 5ms}
  t: {type: Accumulate}
connections: [i -> h.in, i -> s.in, i -> t.in]
)");
    const Plan plan(graph);
    const RunState state(plan);
    CHECK(state.status[0].kept != nullptr);
    CHECK(state.status[1].kept != nullptr);
    CHECK(state.status[2].kept == nullptr);
    CHECK(state.status[0].recoverable);
    CHECK_FALSE(state.status[2].recoverable);
  }

  TEST_CASE("every fault is counted, the first thousand are reported") {
    const auto r = run(", on_fault: hold, parameters: {first: 0, count: 5000}", 20s);
    CHECK(r.report.fault_count == 2000);
    CHECK(r.report.faults.size() == 1000);
    CHECK(lines_of(r, "f.out") == "");
  }
}
