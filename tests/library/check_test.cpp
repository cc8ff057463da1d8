// What jarol check finds out, as a program has it.
#include <doctest/doctest.h>
#include <jarol/check.h>
#include <jarol/runner.h>

using namespace std::chrono_literals;
using jarol::analysis::Verdict;

TEST_CASE("a graph that can't be scheduled comes with what would help, and each of it does") {
  const jarol::Overrides overrides{"", {"tasks.speed.wcet=60ms"}};
  const jarol::CheckedGraph checked = jarol::check(SPECS "/exolauv.yaml", {.overrides = overrides});
  CHECK(checked.found.result.verdict == Verdict::not_schedulable);
  REQUIRE(checked.found.result.late);
  CHECK(checked.loaded.graph->tasks[checked.found.result.late->task].name == "speed");
  REQUIRE(checked.remedies.size() > 1);
  CHECK(checked.remedies[0].text == "'let: 62.5ms' of 'speed'");
  CHECK(checked.remedies[0].set == std::vector<std::string>{"tasks.speed.let=62.5ms"});
  for (const jarol::analysis::Remedy& remedy : checked.remedies) {
    jarol::Overrides changed = overrides;
    changed.set.insert(changed.set.end(), remedy.set.begin(), remedy.set.end());
    CHECK(jarol::check(SPECS "/exolauv.yaml", {.overrides = changed}).found.result.verdict == Verdict::schedulable);
  }
}

TEST_CASE("a graph that holds needs no help, and has margins and the latencies of its chains") {
  const jarol::CheckedGraph checked = jarol::check(SPECS "/exolauv.yaml");
  CHECK(checked.found.result.verdict == Verdict::schedulable);
  CHECK(checked.remedies.empty());
  REQUIRE(checked.found.sensitivity);
  CHECK(*checked.found.sensitivity->alpha > 27);
  REQUIRE(checked.found.chains.size() == 1);
  CHECK(checked.found.chains[0].chain.name == "steer");
  CHECK(jarol::analysis::chains_hold(checked.found) == true);
}

TEST_CASE("how long tasks take here is measured, and what their wcet could be") {
  jarol::Loaded loaded = jarol::load(SPECS "/counting.yaml");
  const jarol::Measurement measured = jarol::measure_tasks(loaded, 1s);
  CHECK(measured.over == 1s);
  REQUIRE(measured.tasks.size() == loaded.graph->tasks.size());
  CHECK(measured.tasks[0].activations == 50);
  const auto wcets = jarol::choose_wcets(*loaded.graph, measured, *loaded.graph);
  CHECK((wcets[0].kept || *wcets[0].written > jarol::min_disturbance));
}
