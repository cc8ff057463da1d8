// An external system that is lost in the middle of an instant: the instant counts whole or not at all.
#include <doctest/doctest.h>

#include <stdexcept>

#include "tests/runtime/outside.h"
#include "tests/runtime/trace_of.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Throws where it is handed something at that instant.
class LostPlant : public tests::Outside {
 public:
  explicit LostPlant(Duration at) : at_(at) {}
  void reach(Duration instant) override { now_ = instant; }
  bool take(std::size_t, void*) override { return false; }
  void hand_over(std::size_t, const void*) override {
    if (now_ == at_) throw std::runtime_error("no carrier");
  }

 private:
  Duration at_, now_{};
};

// `mean` is published before `o` is handed over.
Report run_until_lost(Duration at, Duration end) {
  Registry registry;
  tasks::add_tasks(registry);
  registry.add(tests::plant());
  const Graph graph = tests::graph_of(registry, tests::plant_graph);
  std::vector<std::unique_ptr<ExternalSystem>> systems;
  systems.push_back(std::make_unique<LostPlant>(at));
  Executor executor(graph, std::move(systems), {.digest = true});
  if (at < end)
    CHECK_THROWS_WITH_AS(executor.run_until(end), "no carrier", std::runtime_error);
  else
    executor.run_until(end);
  return executor.report();
}
}  // namespace

TEST_SUITE("runtime/lost_system") {
  TEST_CASE("an instant in which an external system is lost is run to its end, and counts as a whole") {
    const Report lost = run_until_lost(30ms, 50ms), whole = run_until_lost(50ms, lost.covered);
    CHECK(lost.covered == 30ms + 1ns);
    CHECK(lost.digest == whole.digest);
    CHECK(lost.activations == whole.activations);
    CHECK(lost.instants == whole.instants);
    CHECK(lost.fault_count == whole.fault_count);
  }
}
