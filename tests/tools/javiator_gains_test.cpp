// Gains that the operator sends change the flight as a hand computation says.
#include <doctest/doctest.h>

#include "tests/tools/flight.h"

namespace {
using namespace jarol;

const tests::Flight& the_flight() {
  static const tests::Flight flight =
      tests::fly({.set = {"distributers.terminal.link.file=../tests/data/javiator-gains.csv"}, .profile = "original"});
  return flight;
}

double first(tasks::FlightState state) {
  for (const auto& [time, directive] : the_flight().directives)
    if (directive.state == state) return time;
  return -1;
}
}  // namespace

TEST_SUITE("tools/javiator_gains") {
  TEST_CASE("the rotors are spun up to the idle signal that was sent: 7000 in 140 periods") {
    CHECK(first(tasks::FlightState::flying) - first(tasks::FlightState::starting) == doctest::Approx(140 * 0.015));
  }

  // 1.5 kg hang on 4 x 9.81 N x (signal / 16000)^1.415 at a signal of 8000; without an integral the error alone makes
  // up for what the idle signal lacks: 1000 / kp, in mm
  TEST_CASE("it hangs 667 mm below what is commanded at kp 1.5, and 333 mm at kp 3") {
    CHECK(the_flight().report.fault_count == 0);
    CHECK(the_flight().at(14.9).altitude == doctest::Approx(1 - 1.0 / 1.5).scale(0).epsilon(0.02));
    CHECK(the_flight().at(24.9).altitude == doctest::Approx(1 - 1.0 / 3).scale(0).epsilon(0.02));
  }

  TEST_CASE("the laws of this graph have gains of their own, whatever is sent") {
    const tests::Flight flight =
        tests::fly({.set = {"distributers.terminal.link.file=../tests/data/javiator-gains.csv"}});
    CHECK(flight.at(14.9).altitude == doctest::Approx(1).scale(0).epsilon(0.03));
  }
}
