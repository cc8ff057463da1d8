// The whole graph with its vehicle on the virtual clock, and its law alone.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <cmath>

#include <jarol/session.h>

#include "tasks/drive_to.h"

using namespace std::chrono_literals;

TEST_CASE("after twenty seconds the rover stands where it was to go") {
  auto session = jarol::open("@NAME@.yaml");
  session.watch("drive");
  session.run_until(20s);
  CHECK(std::hypot(session.true_value("north of rover") - 8, session.true_value("east of rover") - 6) < 0.1);
  CHECK(session.value<Drive>("drive").speed == 0);
  for (const auto& [instant, drive] : session.samples<Drive>("drive")) CHECK(drive.speed <= 1);
  // and what the graph expects of itself
  CHECK_FALSE(session.finish().is_negative());
}

TEST_CASE("it turns to what lies on its right, and does not drive before it looks there") {
  DriveTo::Out out;
  DriveTo::run({.north = 0, .east = 5}, {}, {.pose = {}}, out);
  CHECK(out.drive.turn > 1);
  CHECK(out.drive.speed < 1e-9);
}
