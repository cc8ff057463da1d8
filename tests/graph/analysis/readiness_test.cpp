#include "graph/analysis/readiness.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol::analysis;
using namespace std::chrono_literals;
}  // namespace

TEST_SUITE("graph/analysis/readiness") {
  TEST_CASE("a chain hands down the longest jitter and blocking, in whatever order its tasks stand") {
    CoreTasks tasks;
    tasks.models.assign(4, {.wcet = 1ns, .period = 10ns, .deadline = 10ns});
    tasks.models[3].jitter = 5ns;
    tasks.models[2].blocking = 3ns;
    tasks.models[1].jitter = 7ns;
    tasks.follows = {{1, 0}, {2, 1}, {3, 2}};
    const TaskModels models = inheriting_loads(tasks);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(models[i].jitter == (i < 2 ? 7ns : 5ns));
      CHECK(models[i].blocking == (i < 3 ? 3ns : 0ns));
    }
    ReadinessAt ready(tasks);
    CHECK(ready(0, 20ns).jitter == 7ns);
    CHECK(ready(2, 20ns).jitter == 5ns);
    CHECK(ready(0, 20ns).blocking == 3ns);
  }

  TEST_CASE("who arrives more often than what it follows waits for that at their common instants alone") {
    CoreTasks tasks;
    tasks.models = {{.wcet = 1ns, .period = 20ns, .deadline = 20ns, .jitter = 5ns},
                    {.wcet = 1ns, .period = 10ns, .deadline = 10ns}};
    tasks.follows = {{0, 1}};
    ReadinessAt ready(tasks);
    CHECK(ready(1, 0ns).jitter == 5ns);
    CHECK(ready(1, 10ns).jitter == 0ns);
    CHECK(ready(1, 20ns).jitter == 5ns);
  }
}
