// Counts every call of the global allocator: running makes none.
#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/runtime/trace_of.h"

namespace {
std::atomic<std::uint64_t> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  void* memory = alignment > alignof(std::max_align_t)
                     ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
                     : std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return counted(size, 0);
  } catch (...) { return nullptr; }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

TEST_SUITE("runtime/allocation") {
  using namespace jarol;
  using namespace std::chrono_literals;

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
    const std::uint64_t before = allocations.load();
    ::operator delete(::operator new(4));  // not a new-expression: compilers may leave such a pair out
    CHECK(allocations.load() == before + 1);
  }

  TEST_CASE("a million activations allocate nothing") {
    const Graph graph = tests::graph_of(mixed);
    Executor executor(graph, {});
    const std::uint64_t before = allocations.load();
    executor.run_until(600s);
    const std::uint64_t during = allocations.load() - before;
    CHECK(executor.report().activations > 1'000'000);
    CHECK(during == 0);
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
    const std::uint64_t before = allocations.load();
    executor.run_until(250s);
    const std::uint64_t during = allocations.load() - before;
    CHECK(executor.report().activations > 1'000'000);
    CHECK(executor.report().fault_count == 0);
    CHECK(during == 0);
  }
}
