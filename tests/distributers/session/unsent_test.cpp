// Safe values that did not go out at the end of a run.
#include <doctest/doctest.h>

#include "distributers/session/linked.h"
#include "tests/graph/graph_of.h"
#include "tests/runtime/outside.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

// Sends two values, where `ready`, and no more.
class FullPlant : public tests::Outside {
 public:
  explicit FullPlant(bool ready) : room_(ready ? 2 : 0) {}
  void hand_over(std::size_t, const void*) override { ++handed_; }
  std::uint64_t unsent() const override { return handed_ < room_ ? 0 : handed_ - room_; }
  bool has_sent() const override { return room_ > 0; }

 private:
  const std::uint64_t room_;
  std::uint64_t handed_ = 0;
};

Graph graph_with_safe_value() {
  Registry registry;
  tasks::add_tasks(registry);
  registry.add(tests::plant());
  return tests::graph_of(registry, R"(graph: t
timing: {period: 3ms}
distributers: {p: {type: Plant, link: {type: test}}}
communicators: {i: {channel: p.sensor, timeout: 1s}, o: {channel: p.actuator, safe: -1}}
tasks: {r: {type: Relay}}
connections: [i -> r.in, r.out -> o]
)");
}

// Of what was handed over so many times why the last was not.
FailsafeReport::AtEnd end_of_safe(bool ready, int times, bool later = false) {
  const Graph graph = graph_with_safe_value();
  std::vector<std::unique_ptr<ExternalSystem>> systems;
  systems.push_back(std::make_unique<FullPlant>(ready));
  Failsafe failsafe(graph);
  for (int i = 0; i < times; ++i) failsafe.hand_over_at_end(systems, 1s, false);
  if (later) systems[0]->hand_over(0, nullptr);
  return failsafe_after({}, graph, pointers_to(systems), failsafe.reports()).at(0).at_end.value();
}
}  // namespace

TEST_SUITE("distributers/unsent") {
  TEST_CASE("a safe value that found no room, or could not be sent after it was given, was not handed over") {
    CHECK(end_of_safe(true, 2).failure == "");
    for (const FailsafeReport::AtEnd& end : {end_of_safe(true, 3), end_of_safe(true, 2, true)}) {
      CHECK(end.failure == "the link had no room for it, or nobody to send it to any more");
      CHECK_FALSE(end.is_alone);
    }
  }

  TEST_CASE("where nothing ever went out there was nobody to be handed a safe value") {
    const FailsafeReport::AtEnd end = end_of_safe(false, 1);
    CHECK(end.failure == "the link had nobody to send it to all along");
    CHECK(end.is_alone);
  }
}
