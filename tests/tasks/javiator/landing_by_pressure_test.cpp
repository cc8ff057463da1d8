// How the helicopter touches the ground where no sonar shows how high it is.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/tasks/javiator/hovering_law.h"

namespace {
using namespace jarol::tasks;
using jarol::tests::Altitude;
using jarol::tests::dt;
using jarol::tests::g_earth;

Altitude landing_without_sonar() {
  Altitude a;
  a.in.directive = {.state = FlightState::landing};
  a.in.estimate.altitude_known = false;
  a.in.estimate.pressure_known = true;
  return a;
}

// Its thrust is demanded and felt, and the ground carries a part of g beyond it.
Altitude carried_by(double part) {
  Altitude a = landing_without_sonar();
  a.state.z = {.place = 0.1, .speed = -0.2};
  a.in.estimate.altitude = 0.1;
  a.in.estimate.climb = -0.2;
  a.state.trim = 0.5;
  a.in.estimate.lift = (0.5 + part) * g_earth;
  return a;
}
}  // namespace

TEST_SUITE("tasks/landing_by_pressure") {
  TEST_CASE("a foot may stand up to 3 cm above where it would, by the pressure, and not where nothing shows it") {
    const double learnt = 1 + 10 * dt * (1 - 1.5), foot = 0.2 * std::sin(0.2);
    const auto trim_at = [](double altitude, bool pressure_known) {
      Altitude a = landing_without_sonar();
      a.in.estimate.roll = -0.2;
      a.in.estimate.lift = 1.5 * g_earth;
      a.in.estimate.altitude = altitude;
      a.in.estimate.pressure_known = pressure_known;
      a.run();
      return a.state.trim;
    };
    CHECK(trim_at(foot + 0.03 - 1e-6, true) == doctest::Approx(1 - 0.8 * dt * dt));
    CHECK(trim_at(foot + 0.03 + 1e-6, true) == doctest::Approx(learnt));
    CHECK(trim_at(foot, false) == doctest::Approx(learnt));
  }

  TEST_CASE("one that has stood on a foot does so until it is level, however high the pressure shows it") {
    Altitude a = landing_without_sonar();
    a.in.estimate.roll = -0.2;
    a.in.estimate.lift = 1.5 * g_earth;
    a.state.on_foot = dt;
    a.run();
    CHECK(a.state.trim == doctest::Approx(1 - 0.8 * 2 * dt * dt));
    a.in.estimate.roll = -0.049;
    a.run();
    CHECK(a.state.trim < 0.95);
  }

  TEST_CASE("it stands, and is to level, as soon as the ground carries a quarter of it, and no longer") {
    Altitude a = carried_by(0.5);
    a.run();
    CHECK(a.state.lifted);
    CHECK(a.out.lift.thrust < 0.6);
    CHECK(a.out.lift.stands);
    a.in.estimate.lift = a.out.lift.thrust * g_earth;
    a.run();
    CHECK_FALSE(a.out.lift.stands);
    Altitude light = carried_by(0.2);
    light.run();
    CHECK_FALSE(light.out.lift.stands);
  }

  TEST_CASE("with much thrust, a confirmed altitude, or commanded to fly, it does not count as standing") {
    Altitude strong = carried_by(0.5), measured = strong, flying = strong;
    strong.state.trim = 1;
    strong.in.estimate.lift = 1.5 * g_earth;
    strong.run();
    CHECK_FALSE(strong.out.lift.stands);
    measured.in.estimate.altitude_known = true;
    measured.run();
    CHECK(measured.out.lift.stands);  // by a sonar that nothing confirms
    Altitude unfelt = carried_by(0.5);
    unfelt.in.estimate.altitude_known = unfelt.in.estimate.lean_known = true;
    unfelt.state.foot_cut = 1;
    unfelt.run();
    CHECK_FALSE(unfelt.out.lift.stands);  // without an IMU lift is no measurement
    measured.in.estimate.altitude_confirmed = true;
    measured.run();
    CHECK_FALSE(measured.out.lift.stands);
    flying.in.directive = {.state = FlightState::flying, .altitude = 0.1};
    flying.run();
    CHECK_FALSE(flying.out.lift.stands);
  }
}
