// The original laws against a recorded flight: a JAviator's own controller and terminal, with a simulated vehicle.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/tools/flight.h"

namespace {
using namespace jarol;

// What the controller reported to its terminal, every fifth of its periods.
struct Reported {
  double time = 0, altitude = 0, roll = 0, yaw = 0;
};

std::vector<Reported> read_recording() {
  std::vector<Reported> all;
  std::ifstream file("tests/data/javiator-flight.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    for (char& c : line)
      if (c == ',') c = ' ';
    Reported r;
    std::istringstream(line) >> r.time >> r.altitude >> r.roll >> r.yaw;
    all.push_back(r);
  }
  return all;
}

const tests::Flight& the_original_flight() {
  static const tests::Flight flight = tests::fly({.profile = "original"});
  return flight;
}

double truth_at(double time) { return the_original_flight().at(time).altitude; }

constexpr double landed_at = 36.1;  // s, before the operator switches the state
}  // namespace

TEST_SUITE("tools/javiator_original") {
  TEST_CASE("commanded alike, it reports the recorded altitude within 5 cm and the recorded roll within 15 mrad") {
    const auto recording = read_recording();
    REQUIRE(recording.size() > 400);
    double altitude = 0, roll = 0, yaw = 0, highest = 0, furthest = 0;
    std::size_t i = 0;
    for (const Reported& r : recording) {
      if (r.time > landed_at) break;
      while (the_original_flight().estimates[i].first < r.time - 1e-6) ++i;
      const tasks::FlightEstimate& e = the_original_flight().estimates[i].second;
      altitude = std::max(altitude, std::abs(e.altitude - r.altitude));
      roll = std::max(roll, std::abs(e.roll - r.roll));
      yaw = std::max(yaw, std::abs(e.yaw - r.yaw));
      highest = std::max(highest, r.altitude);
      furthest = std::max(furthest, r.roll);
    }
    MESSAGE("apart at most " << altitude << " m, " << roll << " rad of roll, " << yaw << " rad of yaw");
    CHECK(highest > 0.6);     // the recording does fly,
    CHECK(furthest > 0.095);  // and lean
    CHECK(altitude < 0.05);
    CHECK(roll < 0.015);
    CHECK(yaw < 0.02);
  }

  TEST_CASE("what it reports is true within 2 cm in quiet flight") {
    for (const auto& [time, e] : the_original_flight().estimates)
      if (time > 10 && time < 29) CHECK(std::abs(e.altitude - truth_at(time)) < 0.02);
  }

  TEST_CASE("it overshoots as the recorded one did: 124 mm after take-off") {
    CHECK(the_original_flight().max(&tests::Glimpse::altitude, 5, 15) == doctest::Approx(0.624).scale(0).epsilon(0.02));
  }

  TEST_CASE("it ends halted, as the operator's shut-down demands, without a fault") {
    CHECK(the_original_flight().last().state == tasks::FlightState::halt);
    CHECK(the_original_flight().last().cause == tasks::LandingCause::none);
    CHECK(the_original_flight().report.fault_count == 0);
  }

  TEST_CASE("without the operator it stops its motors after 525 ms and drops, as the original does") {
    const auto pilot = [](double time) {
      tasks::PilotCommand command;
      command.state_switches = (time >= 0.5 ? 1U : 0U) + (time >= 1 ? 1U : 0U);
      command.altitude = time >= 4 ? 1 : 0;
      command.heard = time < 8;
      return command;
    };
    const tests::Flight flight = tests::fly({.profile = "original", .pilot = pilot, .seconds = 12});
    double halted = 0;
    for (const auto& [time, directive] : flight.directives)
      if (directive.state != tasks::FlightState::halt) halted = time;
    CHECK(halted == doctest::Approx(8.535).scale(0).epsilon(0.005));
    CHECK(flight.last().cause == tasks::LandingCause::operator_lost);
    CHECK(flight.touch_down() > 3);
  }
}
