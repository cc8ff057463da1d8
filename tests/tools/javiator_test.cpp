// The helicopter's flights, from the file that users run: what they have to reach.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/tools/flight.h"

namespace {
using namespace jarol;
using tests::Flight;
using tests::Glimpse;
}  // namespace

TEST_SUITE("tools/javiator") {
  TEST_CASE("the mission takes off, leans, comes back and lands") {
    const Flight flight = tests::fly({});
    CHECK(flight.report.fault_count == 0);
    CHECK(flight.at(13).altitude == doctest::Approx(1).epsilon(0.02));
    CHECK(flight.at(15.3).roll == doctest::Approx(0.075).epsilon(0.05));
    CHECK(flight.at(28).y == doctest::Approx(3).epsilon(0.02));
    CHECK(flight.touch_down() > 0);
    CHECK(flight.touch_down() < 0.5);
    CHECK(std::abs(flight.path.back().altitude) < 0.001);
    CHECK(flight.last().state == tasks::FlightState::ground);
    CHECK(flight.last().cause == tasks::LandingCause::none);
  }
}
