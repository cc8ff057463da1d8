// The helicopter's law of altitude without its IMU: each gain, limit and time, at its edge.
#include <doctest/doctest.h>

#include "tasks/javiator/altitude_control.h"
#include "tests/tasks/javiator/hovering_law.h"

namespace {
using namespace jarol::tasks;
using jarol::tests::Altitude;
using jarol::tests::dt;
}  // namespace

TEST_SUITE("tasks/javiator_control/blind") {
  TEST_CASE("blind, it sinks at 25 cm/s near what carried it, with up to 6 hundredths more and 20 less") {
    const auto first = [](double climb, bool measured) {
      Altitude a;
      a.in.estimate.rates_known = false;
      a.in.estimate.answers_known = measured;
      a.in.estimate.climb = climb;
      return a.run() + (measured ? -a.state.blind_trim : a.state.blind_cut);
    };
    for (const bool measured : {true, false}) {
      CHECK(first(-0.25, measured) == doctest::Approx(1 - 0.03));
      CHECK(first(-0.15, measured) == doctest::Approx(1 - 0.03 - 0.15 * 0.1));
      CHECK(first(2, measured) == doctest::Approx(1 - 0.03 - (measured ? 0.2 : 0.06)));
      CHECK(first(-2, measured) == doctest::Approx(1 - 0.03 + 0.06));
    }
  }

  TEST_CASE("blind, it learns what carries it as long as that is measured, up to 20 hundredths") {
    for (const double side : {-1.0, 1.0}) {
      Altitude a;
      a.in.estimate.rates_known = false;
      a.in.estimate.climb = -0.25 - 0.1 * side;
      const double at_first = 1 - 0.03 + 0.015 * side;
      CHECK(a.run(100) == doctest::Approx(at_first + 0.1 * 0.1 * side * 100 * dt));
      CHECK(a.run(2000) == doctest::Approx(at_first + 0.2 * side));
      a.in.estimate.climb = -0.25;
      a.in.estimate.rates_known = true;
      a.run();
      a.in.estimate.rates_known = false;
      CHECK(a.run() == doctest::Approx(a.state.mean_trim - 0.03));
    }
  }

  TEST_CASE("blind, with nothing measured, it keeps nothing that lifts it, and has no thrust after 20 s") {
    for (const auto lost : {&FlightEstimate::altitude_known, &FlightEstimate::answers_known}) {
      Altitude a;
      a.state.blind_trim = 0.15;
      a.in.estimate.rates_known = a.in.estimate.*lost = false;
      a.in.estimate.climb = -0.25;
      CHECK(a.run() == doctest::Approx(1 - 0.03 - 0.005 * dt));
      CHECK(a.run(599) == doctest::Approx(1 - 0.03 - 0.005 * 600 * dt));
      // after ten seconds it is down, and may lie there
      CHECK(a.run(200) == doctest::Approx(1 - 0.03 - 0.05 - 0.1 * (800 * dt - 10)).scale(0).epsilon(0.005));
      CHECK(a.run(534) == 0);
    }
  }

  TEST_CASE("blind, where the sonar shows less than 2 cm, it takes back its thrust within half a second, for good") {
    Altitude a;
    a.in.estimate.rates_known = false;
    a.in.estimate.climb = -0.25;
    a.in.estimate.altitude = 0.021;
    CHECK(a.run(10) == doctest::Approx(1 - 0.03));
    a.in.estimate.altitude = 0.019;
    CHECK(a.run(10) == doctest::Approx(1 - 0.03 - 10 * dt / 0.5));
    a.in.estimate.altitude = 0.03;
    CHECK(a.run(10) == doctest::Approx(1 - 0.03 - 10 * dt / 0.5));
    a.in.estimate.altitude = 0.01;
    CHECK(a.run(100) == 0);
  }

  TEST_CASE("what carries it is the mean since it left the ground, four seconds at most, begun with hover's") {
    Altitude a;
    a.state.lifted = false;
    a.state.trim = 1.2;
    a.in.estimate.altitude = 0.021;
    a.run();
    CHECK(a.state.lifted);
    CHECK(a.state.mean_trim == 1);
    CHECK(a.state.aloft == 0.4);
    a.run();
    CHECK(a.state.mean_trim == doctest::Approx((0.4 + dt * a.state.trim) / (0.4 + dt)));
    a.run(1000);
    CHECK(a.state.aloft == 4);
  }

  TEST_CASE("what it has left the ground with when it is to land is a flight") {
    Altitude a;
    a.state.lifted = false;
    a.in.directive.state = FlightState::landing;
    a.in.estimate.altitude = 0.021;
    a.run();
    CHECK(a.state.lifted);
  }
}
