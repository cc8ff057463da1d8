#include "graph/analysis/readiness.h"

#include <doctest/doctest.h>

namespace {
using namespace jarol::analysis;
}  // namespace

TEST_SUITE("graph/analysis/readiness") {
  TEST_CASE("a chain hands down the longest jitter and blocking, in whatever order its tasks stand") {
    CoreTasks tasks;
    tasks.models.assign(4, {.wcet = 1, .period = 10, .deadline = 10});
    tasks.models[3].jitter = 5;
    tasks.models[2].blocking = 3;
    tasks.models[1].jitter = 7;
    tasks.follows = {{1, 0}, {2, 1}, {3, 2}};
    const TaskModels models = inheriting_loads(tasks);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(models[i].jitter == (i < 2 ? 7 : 5));
      CHECK(models[i].blocking == (i < 3 ? 3 : 0));
    }
    ReadinessAt ready(tasks);
    CHECK(ready(0, 20).jitter == 7);
    CHECK(ready(2, 20).jitter == 5);
    CHECK(ready(0, 20).blocking == 3);
  }

  TEST_CASE("who arrives more often than what it follows waits for that at their common instants alone") {
    CoreTasks tasks;
    tasks.models = {{.wcet = 1, .period = 20, .deadline = 20, .jitter = 5}, {.wcet = 1, .period = 10, .deadline = 10}};
    tasks.follows = {{0, 1}};
    ReadinessAt ready(tasks);
    CHECK(ready(1, 0).jitter == 5);
    CHECK(ready(1, 10).jitter == 0);
    CHECK(ready(1, 20).jitter == 5);
  }
}
