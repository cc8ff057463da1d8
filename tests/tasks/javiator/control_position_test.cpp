// The numbers of the helicopter's law of position: each gain, sign and limit, by one step from a known state.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tasks/javiator/control.h"
#include "tests/tasks/javiator/every_15_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;

using tests::dt;
using tests::g_earth;
using tests::tick;

struct Position {
  PositionControl::State state{.holding = true};
  PositionControl::Out out{};
  PositionControl::In in{
      .estimate = {.lift = g_earth, .rates_known = true, .attitude_known = true, .position_known = true},
      .directive = {.state = FlightState::flying, .hold_position = true}};

  void run(int periods = 1) {
    for (int i = 0; i < periods; ++i) PositionControl::run({}, tick, in, state, out);
  }
  // The acceleration to the north that a level helicopter has from its lean.
  double north() const { return -g_earth * std::tan(out.goal.pitch); }
  double east() const { return g_earth * std::tan(out.goal.roll); }
};
}  // namespace

TEST_SUITE("tasks/javiator_control/position") {
  TEST_CASE("an error of place is 4/s^2, and 0.3/s^3 of its integral, an error of speed 3.6/s") {
    for (const double side : {-1.0, 1.0}) {
      Position p;
      p.in.estimate.x = -0.1 * side;
      p.in.estimate.y = 0.05 * side;
      p.run();
      CHECK(p.north() == doctest::Approx(side * (4 * 0.1 + 0.3 * 0.1 * dt)));
      CHECK(p.east() == doctest::Approx(-side * (4 * 0.05 + 0.3 * 0.05 * dt)));
      Position v;
      v.in.estimate.v_x = -0.1 * side;
      v.in.estimate.v_y = 0.05 * side;
      v.run();
      CHECK(v.north() == doctest::Approx(side * 3.6 * 0.1));
      CHECK(v.east() == doctest::Approx(-side * 3.6 * 0.05));
    }
  }

  TEST_CASE("drag is leant against once it has lasted a tenth of a second") {
    Position p;
    p.in.estimate.drag_x = 0.5;
    p.run();
    CHECK(p.north() == doctest::Approx(-0.5 * dt / (0.1 + dt)));
  }

  TEST_CASE("it leans by 0.4 rad at most") {
    Position p;
    p.in.estimate.x = -10;
    p.in.estimate.y = 10;
    p.run();
    CHECK(p.out.goal.pitch == -0.4);
    CHECK(p.out.goal.roll == -0.4);
  }

  TEST_CASE("a way begins with 12 m/s^3, is felt with a lag of 0.2 s, and near its end it is critically damped") {
    Position p;
    p.in.directive.x = 100;
    p.run();
    CHECK(p.state.x.demand == doctest::Approx(12 * dt));
    CHECK(p.state.x.felt == doctest::Approx(12 * dt * dt / (0.2 + dt)));
    Position near;
    near.in.directive.x = 0.01;
    near.run();
    CHECK(near.state.x.demand == doctest::Approx(1.6 * 1.6 * 0.01));
    Position moving;
    moving.state.x.speed = 0.01;
    moving.run();
    CHECK(moving.state.x.demand == doctest::Approx(-2 * 1.6 * 0.01));
  }

  TEST_CASE("a long way is flown with 2.5 m/s^2 at most, at 2.5 m/s") {
    Position p;
    p.in.directive.x = -100;
    double fastest = 0;
    for (int i = 0; i < 1000; ++i) {
      p.run();
      fastest = std::min(fastest, p.state.x.demand);
    }
    CHECK(fastest == -2.5);
    CHECK(p.state.x.speed == doctest::Approx(-2.5));
  }

  TEST_CASE("landing without a place it brakes by a hundredth of a g for each 0.0981 m/s that it still has") {
    Position p;
    p.in.directive = {.state = FlightState::landing, .hold_position = false};
    p.in.estimate.v_x = 0.5;
    p.in.estimate.v_y = -0.25;
    p.run();
    CHECK(p.north() == doctest::Approx(-0.5));
    CHECK(p.east() == doctest::Approx(0.25));
  }
}
