// Counts every call of the global allocator: running makes none.
#include <doctest/doctest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>

#include "runtime/execute/log_end.h"
#include "runtime/record/recording_writer.h"
#include "tests/caught_system_calls.h"
#include "tests/counted_allocations.h"
#include "tests/runtime/at_some_speed.h"
#include "tests/runtime/trace_of.h"

TEST_SUITE("runtime/allocation") {
  using namespace jarol;
  using namespace std::chrono_literals;
  using tests::allocations;

  const char* const mixed = R"(graph: t
communicators:
  i: {type: double, direction: in, period: 5ms}
  o: {type: double, direction: out, period: 5ms}
tasks:
  a: {type: Counter, period: 1ms}
  b: {type: Relay, period: 2ms, let: 1ms}
  c: {type: Sum, period: 5ms}
  d: {type: Accumulate, period: 7ms, on_fault: hold}
connections: [a.out -> b.in, b.out -> c.a, i -> c.b, c.out -> d.in, d.out -> o]
)";

  TEST_CASE("the counter counts") {
    const std::uint64_t before = allocations();
    ::operator delete(::operator new(4));  // not a new-expression: compilers may leave such a pair out
    CHECK(allocations() == before + 1);
  }

  TEST_CASE("a million activations allocate nothing") {
    const Graph graph = tests::graph_of(mixed);
    Executor executor(graph, {});
    const std::uint64_t before = allocations();
    executor.run_until(600s);
    const std::uint64_t during = allocations() - before;
    CHECK(executor.report().activations > 1'000'000);
    CHECK(during == 0);
  }

  TEST_CASE("what a run of a plan asks for memory does not hang on the number of its tasks") {
    const auto asked = [](int tasks) {
      std::string text = "graph: t\ncommunicators:\n  o: {type: double, direction: out, period: 1ms}\ntasks:\n",
                  connections;
      for (int i = 0; i < tasks; ++i) {
        const std::string name = "t" + std::to_string(i);
        text += "  " + name + ": {type: " + (i == 0 ? "Counter" : "Relay") + ", period: " + std::to_string(1 + i) +
                "ms" + (i % 2 == 0 ? ", let: 1ms" : "") + (i % 3 == 0 ? ", on_fault: hold" : "") + "}\n";
        connections += "  - t" + std::to_string(std::max(0, i - 1)) + ".out -> " + (i == 0 ? "o" : name + ".in") + "\n";
      }
      const Graph graph = tests::graph_of(text + "connections:\n" + connections);
      const Plan plan(graph);
      const std::uint64_t before = allocations();
      const RunState state(plan);
      return allocations() - before;
    };
    CHECK(asked(700) == asked(70));
    CHECK(asked(70) < 40);
  }

  TEST_CASE("a million activations on values of changing size allocate nothing once communicators have their room") {
    const Graph graph = tests::graph_of(R"(graph: t
timing: {period: 1ms}
communicators:
  o: {type: 'double[]', direction: out}
tasks:
  c: {type: Counter}
  w: {type: Window, parameters: {length: 40}}
  v: {type: Window, let: 1ms, on_fault: hold, parameters: {length: 300}}
  m: {type: Mean}
  n: {type: Mean}
connections: [c.out -> w.in, c.out -> v.in, w.out -> m.in, v.out -> n.in, w.out -> o]
)");
    Executor executor(graph, {});
    executor.run_until(1s);
    const std::uint64_t before = allocations();
    executor.run_until(250s);
    const std::uint64_t during = allocations() - before;
    CHECK(executor.report().activations > 1'000'000);
    CHECK(executor.report().fault_count == 0);
    CHECK(during == 0);
  }

  TEST_CASE("what calls the system is caught") {
    const std::optional<long> first = tests::first_system_call_of([] { (void)::getppid(); });
    if (!first) MESSAGE("left out: this kernel does not catch system calls");
    if (first) CHECK(*first == SYS_getppid);
    if (first) CHECK(tests::first_system_call_of([] {}) == -1);
  }

  TEST_CASE("the thread that runs tasks neither allocates nor calls the system while all is recorded") {
    const Graph graph = tests::graph_of(R"(graph: t
timing: {period: 1ms}
communicators:
  o: {type: 'double[]', direction: out}
tasks:
  c: {type: Counter}
  w: {type: Window, parameters: {length: 4}}
  v: {type: Window, let: 1ms, parameters: {length: 3}}
  m: {type: Mean}
connections: [c.out -> w.in, c.out -> v.in, w.out -> m.in, w.out -> o]
)");
    const std::string file = std::filesystem::temp_directory_path() / ("allocation_" + std::to_string(::getpid()));
    RecordingWriter writer(file, {.graph = "t", .file = "", .overrides = {}, .clock = "virtual", .what = "all"}, {},
                           graph);
    writer.open();
    Recorder recorder({writer.publications()});
    Executor executor(graph, {}, {.recorder = &recorder, .log = writer.recorder()});
    executor.run_until(1s);
    recorder.catch_up();
    std::uint64_t during = 0;
    // some 700 KiB, so that pieces are handed on, and those who write may sleep all the while
    const std::optional<long> first = tests::first_system_call_of([&] {
      const std::uint64_t before = tests::allocations_of_this_thread();
      executor.run_until(4s);
      recorder.hand_on();
      during = tests::allocations_of_this_thread() - before;
    });
    CHECK(during == 0);
    if (first) CHECK(*first == -1);
    recorder.close();
    writer.close(log_end_of(executor.report()));
    CHECK(std::filesystem::file_size(file) > 100'000);
    std::filesystem::remove(file);
  }

  TEST_CASE("nor do threads that run tasks in real time") {
    const std::string text = R"(graph: t
platform: {policy: fixed_priority}
communicators:
  i: {type: double, direction: in, period: 20ms}
  o: {type: double, direction: out, period: 20ms}
tasks:
  a: {type: Counter, period: 10ms, on_fault: hold}
  b: {type: Relay, period: 20ms, let: 10ms, on_fault: hold}
  c: {type: Sum, period: 20ms, on_fault: hold}
connections: [a.out -> b.in, b.out -> c.a, i -> c.b, c.out -> o]
)";
    CHECK(tests::at_some_speed([&](int times) {
      const Graph graph = tests::graph_of(tests::slowed(text, times));
      const std::vector<analysis::TaskThread> threads = analysis::threads_of(graph);
      RealClock clock(graph.tasks.size());
      Executor executor(graph, {}, {.clock = &clock, .threads = threads});
      clock.start();
      executor.run_until(times * 1ms);
      const std::uint64_t before = allocations();
      executor.run_until(times * 100ms);
      const std::uint64_t during = allocations() - before;
      if (executor.report().fault_count > 0) return false;  // told in words; the machine was late
      CHECK(executor.report().activations == 20);
      CHECK(during == 0);
      return true;
    }));
  }
}
