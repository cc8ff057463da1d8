// Tasks on several threads in real time: what is published is what the virtual clock publishes.
#include "runtime/dispatch/preemptive_threads.h"

#include <doctest/doctest.h>

#include "graph/text/errors.h"
#include "tests/how_many.h"
#include "tests/runtime/random_model.h"
#include "tests/runtime/run_on_threads.h"

namespace {
using namespace jarol;
using namespace jarol::tests::threads;
using tests::lines_of;

// A random graph gives what it gives on the virtual clock.
void check_random_graph(std::uint64_t seed, const Mode& mode, int pieces) {
  constexpr Duration step = 6ms, end = 20 * step;
  const std::string text = oracle::coarse_random_graph(seed, step.count(), [](const auto&) { return "core: ANY"; });
  CAPTURE(seed);
  CAPTURE(mode.name);
  CAPTURE(text);
  const RealRun r = run_undisturbed(on(mode, text), end, "", pieces);
  const tests::Run should = run_virtual(on(table_1, text), end, r.times);
  CHECK(text_of(r.report.faults) == "");
  CHECK(r.report.digest == should.report.digest);
  CHECK(r.report.activations == should.report.activations);
  CHECK(r.report.instants == should.report.instants);
  CHECK(sorted(r.lines) == sorted(should.lines));
}
}  // namespace

TEST_SUITE("runtime/preemptive_threads") {
  TEST_CASE("random graphs publish what they publish on the virtual clock, whoever runs their tasks") {
    const std::uint64_t count = tests::how_many(4, 200);
    for (std::uint64_t seed = 0; seed < count; ++seed)
      for (const Mode& mode : modes) check_random_graph(seed, mode, 1);
  }

  TEST_CASE("inputs are those of the release, whatever is published while a task waits or runs") {
    // `follower` begins when `busy` has ended, and `fast` has published twice more
    const std::string text = R"(graph: t
tasks:
  timed: {type: Counter, period: 10ms, let: 5ms, core: ANY}
  busy: {type: Patient, period: 60ms, let: 60ms, core: ANY, parameters: {waits: 25ms}}
  fast: {type: Counter, period: 10ms, core: ANY}
  follower: {type: Patient, period: 60ms, let: 60ms, core: ANY, parameters: {waits: 1ms}}
connections: [timed.out -> busy.in, fast.out -> follower.in]
)";
    for (const Mode& mode : modes) {
      CAPTURE(mode.name);
      const RealRun r = run_undisturbed(on(mode, text), 190ms);
      CHECK(lines_of(r, "busy.out") == "60ms busy.out=0; 120ms busy.out=5; 180ms busy.out=11");
      CHECK(lines_of(r, "follower.out") == "60ms follower.out=0; 120ms follower.out=6; 180ms follower.out=12");
    }
  }

  TEST_CASE("values are recorded in order of their instants") {
    // a data-flow task that is read late is seen to have ended after others have published at later instants
    const std::string text = R"(graph: t
tasks:
  fast: {type: Counter, period: 5ms, let: 5ms}
  slow: {type: Faulty, period: 40ms, parameters: {faulty: 0, lasts: 12ms}}
  reader: {type: Relay, period: 40ms, offset: 30ms}
connections: [fast.out -> slow.in, slow.out -> reader.in]
)";
    const RealRun r = run_undisturbed(on(priorities_1, text), 40ms);
    CHECK(r.lines == std::vector<std::string>{"0ns slow.out=1000", "5ms fast.out=0", "10ms fast.out=1",
                                              "15ms fast.out=2", "20ms fast.out=3", "25ms fast.out=4",
                                              "30ms fast.out=5", "30ms reader.out=1000", "35ms fast.out=6"});
  }

  TEST_CASE("under SCHED_FIFO a more urgent task preempts, and what it takes is not counted to the other") {
    if (machine().fifo_priority < 4) {
      MESSAGE("this machine does not permit SCHED_FIFO");
      return;
    }
    const std::string text = on(priorities_1, R"(graph: t
tasks:
  long: {type: Busy, period: 100ms, let: 100ms, wcet: 40ms, parameters: {lasts: 40ms}}
  quick: {type: Busy, period: 10ms, let: 5ms, wcet: 2ms, parameters: {lasts: 2ms}}
)");
    RealTimeOptions options;
    options.priority = 4;
    options.core_cpus = {machine().usable.front()};
    RealRun r;
    tests::at_some_speed([&](int times) {
      r = run(text, 200ms, times, options);
      return r.report.fault_count == 0 && r.worst[0] > 25'000'000 && r.worst[0] < 38'000'000;
    });
    CHECK(r.report.fault_count == 0);
    CHECK(r.refusals.empty());
    CHECK(r.report.activations == 22);
    // of 40 ms on the clock, some 8 for the others
    CHECK(r.worst[0] > 25'000'000);
    CHECK(r.worst[0] < 38'000'000);
    CHECK(r.worst[1] >= 2'000'000);
  }

  TEST_CASE("a priority that leaves none for the threads is an error") {
    const std::string text = on(priorities_1, R"(graph: t
tasks: {a: {type: Counter, period: 10ms}, b: {type: Counter, period: 20ms}, c: {type: Counter, period: 20ms}}
)");
    RealTimeOptions options;
    options.priority = 2;
    CHECK_THROWS_WITH_AS(run(text, 10ms, 1, options),
                         "SCHED_FIFO priority 2 is too low; tasks take 2 below it, so that it has to be 3 at least",
                         InputError);
  }

  TEST_CASE("in pieces it is the same run") { check_random_graph(5, priorities_2, 9); }
}
