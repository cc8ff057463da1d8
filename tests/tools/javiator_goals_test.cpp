// What a pilot may command at the edges: turned round, low, beyond a wall; and a failure just before take-off.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/tools/flight.h"

namespace {
using namespace jarol;
using namespace jarol::tests;
using tasks::FlightState;
using tasks::LandingCause;

constexpr double degrees = 3.14159265358979323846 / 180;

// How far it turned from one instant to another, as it leads from glimpse to glimpse.
double turned(const Flight& flight, double from, double to) {
  double turned = 0, max_turn = 0;
  for (std::size_t i = 1; i < flight.path.size(); ++i) {
    if (flight.path[i].time < from || flight.path[i].time > to) continue;
    turned += std::remainder(flight.path[i].yaw - flight.path[i - 1].yaw, 360 * degrees);
    max_turn = std::max(max_turn, std::abs(turned));
  }
  return max_turn;
}

// Hovers until it is sent at 10 s to an altitude, and 1.5 s later to a place 3 m away.
Flight go_low(double altitude, double away_at) {
  return fly({.pilot =
                  [&](double t) {
                    tasks::PilotCommand c = hover_command(t);
                    if (t >= 10) c.altitude = altitude;
                    if (t >= away_at) c.x = 3;
                    return c;
                  },
              .seconds = 20});
}

double furthest_lean(const Flight& flight) {
  return std::max(flight.furthest(&Glimpse::roll, 0, 0, 100), flight.furthest(&Glimpse::pitch, 0, 0, 100));
}

}  // namespace

TEST_SUITE("tools/javiator_goals") {
  TEST_CASE("once turned round and landed, it takes off again with the heading that it stands with") {
    // once round, and half a turn that ends just beyond it
    for (const double part : {120.0, 60.0}) {
      CAPTURE(part);
      const Flight flight = fly({.pilot =
                                     [&](double t) {
                                       tasks::PilotCommand c = hover_command(t);
                                       const double steps = t < 8 ? 0 : t < 13 ? 1 : t < 18 ? 2 : 3;
                                       c.yaw = std::remainder(part * steps * degrees, 360 * degrees);
                                       if (t >= 24) c.state_switches = 3;
                                       if (t >= 30) c = {.state_switches = 4, .mode_switches = 1};
                                       if (t >= 34) c.altitude = 1;
                                       return c;
                                     },
                                 .seconds = 46});
      CHECK(turned(flight, 4, 24) > 2.9 * part * degrees);
      CHECK(flight.at(45).altitude == doctest::Approx(1).scale(0).epsilon(0.05));
      CHECK(turned(flight, 29, 46) < 0.2);
      CHECK(flight.last().state == FlightState::flying);
    }
  }

  TEST_CASE("sent to the ground it stands where it comes down, wherever else it is sent") {
    for (const double away_at : {10.0, 11.0, 11.5, 12.5}) {
      CAPTURE(away_at);
      const Flight flight = go_low(0, away_at);
      CHECK(flight.last().state == FlightState::flying);
      CHECK(flight.last().cause == LandingCause::none);
      CHECK(furthest_lean(flight) < 0.45);
      CHECK(flight.at(20).altitude < 0.01);
      CHECK(flight.impact() < 0.5);
    }
  }

  TEST_CASE("low above the ground it rises to 30 cm for the way to another place") {
    const Flight flight = go_low(0.1, 13);
    CHECK(flight.min(&Glimpse::altitude, 13.6, 15) > 0.15);
    CHECK(flight.at(20).altitude == doctest::Approx(0.1).scale(0).epsilon(0.05));
    CHECK(flight.at(20).x == doctest::Approx(3).scale(0).epsilon(0.1));
    CHECK(furthest_lean(flight) < 0.45);
  }

  TEST_CASE("a place beyond a wall is flown to as far as 1.5 m before the wall") {
    const Flight flight = fly({.pilot =
                                   [](double t) {
                                     tasks::PilotCommand c = hover_command(t);
                                     if (t >= 6) c.x = c.y = 30;
                                     return c;
                                   },
                               .seconds = 25});
    CHECK(flight.last().cause == LandingCause::none);
    for (double Glimpse::*const along : {&Glimpse::x, &Glimpse::y}) {
      CHECK(flight.max(along, 0, 25) < 7);
      CHECK(flight.at(25).*along == doctest::Approx(6.5).scale(0).epsilon(0.2));
    }
  }

  TEST_CASE("an altitude below the ground is that of the ground") {
    for (const double altitude : {-0.5, -1.0, -30.0}) {
      CAPTURE(altitude);
      const Flight flight = go_low(altitude, 100);
      CHECK(flight.at(20).altitude < 0.01);
      CHECK(flight.impact() < 0.4);
    }
  }

  TEST_CASE("a place that is lost in a landing makes it turn along the walls as one lost before") {
    // turned through a corner one axis is unseen already as the key is pressed
    for (const std::uint64_t seed : {1U, 3U, 4U, 12U}) {
      CAPTURE(seed);
      const Flight flight = fly({.pilot =
                                     [](double t) {
                                       tasks::PilotCommand c = hover_command(t);
                                       if (t >= 8) c.x = 2.4, c.y = 1.2;
                                       c.yaw = (t < 8 ? 0 : t < 12 ? 90 : 156) * degrees;
                                       if (t >= 14) ++c.state_switches;
                                       return c;
                                     },
                                 .seconds = 24,
                                 .seed = seed});
      CHECK(flight.last().cause == LandingCause::position_lost);
      CHECK(flight.impact() < 0.45);
      CHECK(std::abs(std::remainder(flight.path.back().yaw, 90 * degrees)) < 0.1);
    }
  }

  TEST_CASE("it does not fly with angles that go wrong while its rotors take up speed") {
    for (const std::string at : {"0.90 s", "0.92 s", "1.5 s", "2.2 s"}) {
      CAPTURE(at);
      const Flight flight =
          fly({.set = {"distributers.robostix.link.parameters.failures.imu={kind: biased, at: " + at + ", by: 0.2}"},
               .pilot = hover_command,
               .seconds = 8});
      CHECK(flight.last().state == FlightState::ground);
      CHECK(flight.last().cause == LandingCause::imu_lost);
      CHECK(flight.max(&Glimpse::altitude, 0, 8) < 0.02);
    }
  }
}
