// A helicopter that is cut off from whoever steers it, and heard again later.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include "tests/tools/flight.h"

namespace {
using namespace jarol;
using tasks::FlightState;
using tests::Flight;
using tests::Glimpse;
}  // namespace

TEST_SUITE("tools/javiator_silence") {
  // It had full thrust as soon as it was heard again, and fell from some 100 m.
  TEST_CASE("cut off in the climb, in hover or as it lands, and heard again, its motors do not start by themselves") {
    struct Cut {
      double at, time;
    };
    for (const Cut cut : {Cut{5.3, 2}, Cut{5.3, 15}, Cut{9, 6}, Cut{9, 15}, Cut{13.5, 2.4}}) {
      CAPTURE(cut.at);
      CAPTURE(cut.time);
      const std::string packets = fmt::format("{{cut_at: {} s, cut_time: {} s}}", cut.at, cut.time);
      const Flight flight =
          tests::fly({.set = {"distributers.robostix.link.parameters.packets=" + packets}, .seconds = 26});
      CHECK(flight.last().state == FlightState::halt);
      CHECK(flight.last().cause == tasks::LandingCause::answers_late);
      CHECK(flight.report.faults.empty());
      const double heard = cut.at + cut.time;
      CHECK(flight.max(&Glimpse::altitude, heard, 26) < flight.at(heard).altitude + 0.02);
      CHECK(flight.at(26).altitude < 0.1);
    }
  }

  TEST_CASE("cut off for a fifth of a second it lands, wherever it is, and stands") {
    for (const double at : {5.3, 6.1, 9.0, 11.0, 13.5, 15.5}) {
      CAPTURE(at);
      const std::string packets = fmt::format("{{cut_at: {} s, cut_time: 0.2 s}}", at);
      const Flight flight =
          tests::fly({.set = {"distributers.robostix.link.parameters.packets=" + packets}, .seconds = 24});
      CHECK(flight.last().state == FlightState::ground);
      CHECK(flight.last().cause == tasks::LandingCause::answers_late);
      CHECK(flight.touch_down() < 0.5);
    }
  }
}
