#include "graph/analysis/threads.h"

#include <doctest/doctest.h>

#include "tests/graph/graph_of.h"

namespace {
using namespace jarol;

// "core.urgency: tasks; ..."
std::string threads_text(const std::string& text) {
  const Graph graph = tests::graph_of(text);
  std::string found;
  for (const analysis::TaskThread& t : analysis::threads_of(graph)) {
    found += (found.empty() ? "" : "; ") + std::to_string(t.core) + "." + std::to_string(t.urgency) + ":";
    for (const std::size_t task : t.tasks) found += " " + graph.tasks[task].name;
  }
  return found;
}
}  // namespace

TEST_SUITE("graph/analysis/threads") {
  TEST_CASE("a table has one thread per core, in data-flow order") {
    const std::string tasks = R"(graph: t
timing: {period: 10ms}
tasks:
  a: {type: Relay, core: 0}
  b: {type: Counter, core: 0}
  c: {type: Counter, core: 1}
connections: [b.out -> a.in]
)";
    CHECK(threads_text(tasks + "platform: {cores: 2}\n") == "0.0: b a; 1.0: c");
    CHECK(threads_text(tasks + "platform: {cores: 3}\n") == "0.0: b a; 1.0: c");
  }

  TEST_CASE("under fixed priorities tasks share a thread where none could preempt another") {
    CHECK(threads_text(R"(graph: t
platform: {policy: fixed_priority}
tasks:
  a: {type: Counter, period: 20ms}
  b: {type: Counter, period: 10ms}
  c: {type: Counter, period: 10ms}
  d: {type: Counter, period: 10ms, offset: 5ms}
  e: {type: Counter, period: 40ms, priority: 1}
)") == "0.0: e; 0.1: b c; 0.2: d; 0.3: a");
  }

  TEST_CASE("under fixed priorities nobody shares a thread behind a task that waits for another core") {
    CHECK(threads_text(R"(graph: t
platform: {policy: fixed_priority, cores: 2}
timing: {period: 10ms}
tasks:
  a: {type: Relay, core: 0, wcet: 1ms}
  p: {type: Counter, core: 1, wcet: 1ms}
  y: {type: Counter, core: 0, wcet: 1ms}
  z: {type: Counter, core: 0, wcet: 1ms}
connections: [p.out -> a.in]
)") == "0.0: a; 0.1: y z; 1.0: p");
  }

  TEST_CASE("under fixed priorities nobody shares a thread behind a task that waits for another thread of its core") {
    // 'a' waits for 'p', which is less urgent than 'c'
    CHECK(threads_text(R"(graph: t
platform: {policy: fixed_priority}
timing: {period: 100ms}
tasks:
  a: {type: Relay, priority: 1}
  c: {type: Counter, priority: 2}
  p: {type: Counter, priority: 5}
connections: [p.out -> a.in]
)") == "0.0: a; 0.1: c p");
    // 'x' waits for 'p', which waits for another core
    CHECK(threads_text(R"(graph: t
platform: {policy: fixed_priority, cores: 2}
timing: {period: 200ms}
tasks:
  q: {type: Counter, core: 1, wcet: 1ms}
  p: {type: Relay, core: 0, wcet: 1ms}
  x: {type: Relay, core: 0, wcet: 1ms}
  z: {type: Counter, core: 0, wcet: 1ms}
connections: [q.out -> p.in, p.out -> x.in]
)") == "0.0: p; 0.1: x; 0.2: z; 1.0: q");
    // those that feed each other in one thread wait for nobody
    CHECK(threads_text(R"(graph: t
platform: {policy: fixed_priority}
timing: {period: 10ms}
tasks:
  a: {type: Counter}
  b: {type: Relay}
  c: {type: Counter}
connections: [a.out -> b.in]
)") == "0.0: a b; 0.1: c");
  }

  TEST_CASE("a communicator is due meanwhile where a task may still run at its instant") {
    const auto due = [](const std::string& offset, const std::string& wcet) {
      return analysis::is_due_meanwhile(
          tests::graph_of("graph: t\ntiming: {period: 100ms}\ncommunicators:\n  o: "
                          "{type: double, direction: out, offset: " +
                          offset + "}\ntasks:\n  a: {type: Counter, wcet: 1ms}\n" + "  b: {type: Work" + wcet +
                          "}\nconnections: [a.out -> o]\n"));
    };
    CHECK(due("20ms", ", wcet: 90ms"));
    CHECK(!due("20ms", ", wcet: 19ms"));  // both take 20 ms
    CHECK(due("20ms", ", wcet: 19000001ns"));
    CHECK(!due("0ms", ", wcet: 90ms"));  // it is at the next release
    CHECK(!due("20ms", ""));             // check has no bound
  }

  TEST_CASE("what is more urgent than what runs before it has a thread of its own") {
    CHECK(threads_text(R"(graph: t
platform: {policy: fixed_priority}
tasks:
  a: {type: Counter, period: 40ms, let: 6ms, priority: 2}
  b: {type: Counter, period: 40ms, let: 40ms, priority: 1}
)") == "0.0: b; 0.1: a");
  }

  TEST_CASE("each core has an order of urgency of its own, on the cores that check assigns") {
    CHECK(threads_text(R"(graph: t
platform: {cores: 2, policy: fixed_priority}
tasks:
  a: {type: Counter, period: 20ms, wcet: 15ms}
  b: {type: Counter, period: 10ms, wcet: 6ms}
  c: {type: Counter, period: 100ms, wcet: 1ms}
)") == "0.0: a; 0.1: c; 1.0: b");
  }
}
