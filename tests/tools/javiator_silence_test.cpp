// A helicopter that is cut off from whoever steers it, and heard again later.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include "tests/tools/flight.h"

namespace {
using namespace jarol;
using tasks::FlightState;
using tests::Flight;
using tests::Glimpse;

constexpr double before_its_key = 26;  // s: the pilot of the script unlocks it again

tasks::FlightDirective directive_at(const Flight& flight, double time) {
  tasks::FlightDirective last;
  for (const auto& [at, directive] : flight.directives)
    if (at <= time) last = directive;
  return last;
}
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
          tests::fly({.set = {"distributers.robostix.link.parameters.packets=" + packets}, .seconds = before_its_key});
      CHECK(directive_at(flight, before_its_key).state == FlightState::halt);
      CHECK(directive_at(flight, before_its_key).cause == tasks::LandingCause::answers_late);
      CHECK(flight.report.faults.empty());
      const double heard = cut.at + cut.time;
      CHECK(flight.max(&Glimpse::altitude, heard, before_its_key) < flight.at(heard).altitude + 0.02);
      CHECK(flight.at(before_its_key).altitude < 0.1);
    }
  }

  TEST_CASE("cut off for a fifth of a second it lands, wherever it is, and stands") {
    for (const double at : {5.3, 6.1, 9.0, 11.0, 13.5, 15.5}) {
      CAPTURE(at);
      const std::string packets = fmt::format("{{cut_at: {} s, cut_time: 0.2 s}}", at);
      const Flight flight =
          tests::fly({.set = {"distributers.robostix.link.parameters.packets=" + packets}, .seconds = before_its_key});
      CHECK(directive_at(flight, before_its_key).state == FlightState::ground);
      CHECK(directive_at(flight, before_its_key).cause == tasks::LandingCause::answers_late);
      CHECK(flight.touch_down() < 0.5);
    }
  }
}
