// Runs of one plan: each has a state of its own, and shares nothing else.
#include <doctest/doctest.h>

#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Flat and deep values, LETs, heaps, faults that are undone, communicators.
const char* const mixed = R"(graph: t
communicators:
  i: {type: double, direction: in, period: 5ms}
  o: {type: double, direction: out, period: 5ms}
  w: {type: 'double[]', direction: out, period: 3ms}
tasks:
  a: {type: Counter, period: 1ms}
  b: {type: Relay, period: 2ms, let: 1ms}
  c: {type: Sum, period: 5ms}
  d: {type: Accumulate, period: 7ms, on_fault: hold}
  e: {type: Window, period: 3ms, let: 2ms, on_fault: hold, parameters: {length: 40}}
  f: {type: Mean, period: 3ms}
  g: {type: Window, period: 2ms, on_fault: skip, heap: 1KiB, parameters: {length: 100}}
connections: [a.out -> b.in, b.out -> c.a, i -> c.b, c.out -> d.in, d.out -> o, a.out -> e.in, e.out -> f.in, e.out -> w, a.out -> g.in]
)";

struct Sums {
  std::uint64_t digest, activations, faults;
  friend bool operator==(const Sums&, const Sums&) = default;
};

Sums sums_of(const Executor& run) { return {run.report().digest, run.report().activations, run.report().fault_count}; }

Sums sums_of_single(const Graph& graph) {
  Executor single(graph, {});
  single.run_until(200ms);
  return sums_of(single);
}
}  // namespace

TEST_SUITE("runtime/shared_plan") {
  TEST_CASE("runs of one plan, one after the other, are each the run of a plan of its own") {
    const Graph graph = tests::graph_of(mixed);
    const Sums single = sums_of_single(graph);
    CHECK(single.faults > 0);
    const Plan plan(graph);
    for (int i = 0; i < 3; ++i) {
      Executor run(plan, {});
      run.run_until(200ms);
      CHECK(sums_of(run) == single);
    }
  }

  TEST_CASE("runs of one plan that take turns instant by instant are so too") {
    const Graph graph = tests::graph_of(mixed);
    const Sums single = sums_of_single(graph);
    const Plan plan(graph);
    Executor one(plan, {}), other(plan, {});
    for (Duration end = 1ms; end <= 200ms; end += 1ms) {
      one.run_until(end);
      other.run_until(end - 500us);
    }
    other.run_until(200ms);
    CHECK(sums_of(one) == single);
    CHECK(sums_of(other) == single);
  }
}
