// The whole graph on the virtual clock, and its law alone.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
#include <jarol/session.h>

#include "tasks/hold_level.h"

using namespace std::chrono_literals;

TEST_CASE("after two seconds the tank is full to the level, and it never overflows") {
  auto session = jarol::open("@NAME@.yaml");
  session.watch("tank.out");
  session.run_until(2s);
  CHECK(session.value<double>("tank.out") == doctest::Approx(3).epsilon(0.001));
  for (const auto& [instant, level] : session.samples<double>("tank.out")) CHECK(level < 3.01);
  // and what the graph expects of itself
  CHECK_FALSE(session.finish().is_negative());
}

TEST_CASE("above its level the tank is let out, no faster than it may be") {
  const HoldLevel::Param parameters{.goal = 1, .max = 0.2};
  HoldLevel::Out out;
  HoldLevel::run(parameters, {}, {.level = 10}, out);
  CHECK(out.inflow == -0.2);
}
