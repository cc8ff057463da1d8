// How the helicopter lands when its IMU is lost, and sonars show how it leans.
#include <doctest/doctest.h>

#include <cmath>

#include "tasks/javiator/altitude_control.h"
#include "tasks/javiator/control.h"
#include "tests/tasks/javiator/driven_logic.h"
#include "tests/tasks/javiator/every_15_ms.h"
#include "tests/tasks/javiator/hovering_law.h"

namespace {
using namespace jarol::tasks;
using jarol::tests::Altitude;
using jarol::tests::dt;
using jarol::tests::g_earth;
using jarol::tests::tick;

Altitude landing_by_sonars() {
  Altitude a;
  a.in.estimate.rates_known = false;
  a.in.estimate.lean_known = a.in.estimate.tilt_known = true;
  a.in.directive.state = FlightState::landing;
  return a;
}

// One that lands without an IMU.
jarol::tests::Logic landing_blind(bool tilt_known, double altitude) {
  jarol::tests::Logic logic;
  logic.fly();
  logic.press();
  logic.in.estimate.rates_known = logic.in.estimate.attitude_known = false;
  logic.in.estimate.lean_known = true;
  logic.in.estimate.tilt_known = tilt_known;
  logic.in.estimate.altitude = altitude;
  return logic;
}
}  // namespace

TEST_SUITE("tasks/landing_by_sonars") {
  TEST_CASE(
      "the place is held by 1.4/s^2 and 4/s, and where a foot may stand it levels in a landing, wherever that is") {
    PositionControl::In in{.estimate = {.x = -0.1, .altitude = 1, .v_y = 0.2, .lean_known = true, .tilt_known = true},
                           .directive = {.state = FlightState::landing, .hold_position = true}};
    PositionControl::State state{.holding = true};
    PositionControl::Out out{};
    PositionControl::run({}, tick, in, state, out);
    CHECK(-g_earth * std::tan(out.goal.pitch) == doctest::Approx(1.4 * 0.1).epsilon(0.01).scale(0));
    CHECK(g_earth * std::tan(out.goal.roll) == doctest::Approx(-4 * 0.2).epsilon(0.01).scale(0));
    in.estimate.touches = true;
    const double roll = out.goal.roll, pitch = out.goal.pitch;
    PositionControl::run({}, tick, in, state, out);
    CHECK(out.goal.roll == doctest::Approx(roll * (1 - dt / 0.13)));
    CHECK(out.goal.pitch == doctest::Approx(pitch * (1 - dt / 0.13)));
    in.directive.hold_position = false;
    PositionControl::run({}, tick, in, state, out);
    CHECK(out.goal.roll == doctest::Approx(roll * (1 - dt / 0.13) * (1 - dt / 0.13)));
    in.directive = {.state = FlightState::flying, .hold_position = true};
    state = {.holding = true};
    PositionControl::run({}, tick, in, state, out);
    CHECK(-g_earth * std::tan(out.goal.pitch) == doctest::Approx(1.4 * 0.1).epsilon(0.02).scale(0));
  }

  TEST_CASE("a landing goes against the wind, by 0.3 s times the acceleration of its drag") {
    const auto accelerates = [](FlightState doing, bool tilt_known) {
      PositionControl::In in{
          .estimate = {.altitude = 1, .drag_x = 1, .drag_y = -0.5, .lean_known = true, .tilt_known = tilt_known},
          .directive = {.state = doing, .hold_position = true}};
      PositionControl::State state{.drag_x = 1, .drag_y = -0.5, .holding = true};
      PositionControl::Out out{};
      PositionControl::run({}, tick, in, state, out);
      CHECK(std::tan(out.goal.roll) == doctest::Approx(0.5 * std::tan(out.goal.pitch)));
      return -g_earth * std::tan(out.goal.pitch);
    };
    CHECK(accelerates(FlightState::landing, true) == doctest::Approx(-1 - 4 * 0.3));
    CHECK(accelerates(FlightState::landing, false) == doctest::Approx(-1));
    CHECK(accelerates(FlightState::flying, true) == doctest::Approx(-1));
  }

  TEST_CASE("near the ground a landing leans by three fifths less, from 9.7 cm down to 3.8 cm") {
    const auto pitch = [](double altitude) {
      PositionControl::In in{.estimate = {.x = -0.1, .altitude = altitude, .lean_known = true, .tilt_known = true},
                             .directive = {.state = FlightState::landing, .hold_position = true}};
      PositionControl::State state{.holding = true};
      PositionControl::Out out{};
      PositionControl::run({}, tick, in, state, out);
      return out.goal.pitch;
    };
    CHECK(pitch(0.098) == pitch(1));
    CHECK(pitch(0.037) == doctest::Approx(0.4 * pitch(1)));
  }

  TEST_CASE("it turns to what is commanded down to the ground, where lasers would not show how it leans") {
    const auto demand = [](bool tilt_known) {
      AttitudeControl::In in{.estimate = {.roll = 0.1, .altitude = 0.01, .lean_known = true, .tilt_known = tilt_known}};
      AttitudeControl::State state{};
      AttitudeControl::Out out{};
      AttitudeControl::run({}, tick, in, state, out);
      return out.turn.roll;
    };
    CHECK(demand(true) < -0.03);
    CHECK(demand(false) == 0);
  }

  TEST_CASE(
      "where a foot may stand it takes back its thrust by 1.4/s, to none, and has it again slowly where none does") {
    Altitude a = landing_by_sonars();
    a.in.estimate.altitude = 0.01;
    a.run(10);
    CHECK(a.state.foot_cut == 0);
    a.in.estimate.touches = true;
    a.run(10);
    CHECK(a.state.foot_cut == doctest::Approx(1.4 * 10 * dt));
    a.in.estimate.touches = false;
    a.run(10);
    CHECK(a.state.foot_cut == doctest::Approx((1.4 - 0.11) * 10 * dt));
    a.in.estimate.touches = true;
    CHECK(a.run(200) == 0);
    CHECK(a.state.foot_cut == 2);
    // one that knows nothing more takes it back in another way
    a.in.estimate.lean_known = a.in.estimate.tilt_known = a.in.estimate.touches = false;
    a.run();
    CHECK(a.state.foot_cut == 0);
  }

  TEST_CASE("where a foot may stand it demands to sink, by 0.25 m/s^2, however low it takes itself to be") {
    Altitude a = landing_by_sonars();
    a.in.estimate.altitude = 0.01;
    a.in.estimate.climb = -1;
    CHECK(a.run() > 1.5);
    a.in.estimate.touches = true;
    const double thrust = a.run();
    CHECK(thrust == doctest::Approx(a.state.trim - 0.25 / g_earth - a.state.foot_cut));
  }

  TEST_CASE("it demands 14.1 m/s^2 for each m/s of wrong climb then, and 7 by lasers or with an IMU") {
    const auto thrust = [](bool tilt_known, double climb, bool rates_known = false) {
      Altitude a = landing_by_sonars();
      a.in.estimate.rates_known = rates_known;
      if (rates_known) a.in.estimate.lean_known = false;
      a.in.estimate.tilt_known = tilt_known;
      a.in.estimate.climb = climb;
      return a.run();
    };
    CHECK(thrust(true, 0) - thrust(true, 0.1) == doctest::Approx(14.1 * 0.1 / g_earth));
    CHECK(thrust(false, 0) - thrust(false, 0.1) == doctest::Approx(7 * 0.1 / g_earth));
    CHECK(thrust(false, 0, true) - thrust(false, 0.1, true) == doctest::Approx(7 * 0.1 / g_earth));
  }

  TEST_CASE(
      "what carried it against a gust, when that was last felt, falls to a third within a second, beside what did on "
      "average") {
    for (const bool tilt_known : {true, false}) {
      Altitude a = landing_by_sonars();
      a.in.estimate.tilt_known = tilt_known;
      a.state.trim = 1.4;
      a.run();
      const double fade = tilt_known ? 0.9 : 1;
      CHECK(a.state.trim == doctest::Approx(1.4 - 0.4 * dt / (fade + dt)));
      a.run(59);
      CHECK(a.state.trim == doctest::Approx(1 + 0.4 * std::exp(-60 * dt / fade)).epsilon(0.01).scale(0));
      CHECK(a.state.mean_trim == 1);
    }
    // felt, it is learnt in four seconds
    Altitude a;
    a.in.estimate.lift = 0.9 * g_earth;
    a.run(1000);
    const double before = a.state.mean_trim;
    a.run();
    CHECK(a.state.aloft == 4);
    CHECK(a.state.mean_trim - before == doctest::Approx((a.state.trim - before) * dt / 4));
  }

  TEST_CASE("one that leans, as sonars show, has not landed yet, as it would fall onto its other feet") {
    const auto lands = [](bool tilt_known) {
      jarol::tests::Logic logic = landing_blind(tilt_known, 0.01);
      logic.in.estimate.pitch = 0.2;
      logic.run(60);
      return logic.run(23);
    };
    CHECK(lands(true) == FlightState::landing);
    CHECK(lands(false) == FlightState::ground);
  }

  TEST_CASE("an updraft holds it up with little thrust: still, but above where a foot stands, it has not landed") {
    const auto lands_after = [](double thrust, bool tilt_known, bool touches) {
      jarol::tests::Logic logic = landing_blind(tilt_known, 0.15);
      logic.in.estimate.touches = touches;
      logic.in.lift.thrust = thrust;
      int periods = 0;
      while (logic.run(1) == FlightState::landing && periods < 1000) ++periods;
      return periods * dt;
    };
    CHECK(lands_after(0.7, true, false) == doctest::Approx(5).epsilon(0.02).scale(0));
    CHECK(lands_after(0.9, true, false) == doctest::Approx(5).epsilon(0.02).scale(0));
    CHECK(lands_after(0.7, true, true) < 1.1);
    // still and light: so it may stand on ground that is higher than where it took off
    CHECK(lands_after(0.5, true, false) == doctest::Approx(1.5).epsilon(0.05).scale(0));
    // by one range it may well stand on something
    CHECK(lands_after(0.7, false, false) < 1.1);
  }
}
