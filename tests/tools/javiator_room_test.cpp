// The helicopter turned in its room, whose walls do not turn with it: with both sets of laws.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/tools/flight.h"

namespace {
using namespace jarol;
using tests::Flight;
using tests::Glimpse;

constexpr double pi = std::numbers::pi;

// Takes off, turns by half a radian a second to a yaw, and then holds its place for 20 s.
Flight hold_at(double yaw, const std::string& profile, const std::vector<std::string>& set = {}) {
  const auto pilot = [yaw](double time) {
    tasks::PilotCommand command = tests::hover_command(time);
    command.altitude = time >= 4 ? 0.8 : 0;
    command.yaw = std::clamp(0.5 * (time - 9), 0.0, yaw);
    if (time < 20) command.mode_switches = 0;
    return command;
  };
  return tests::fly({.set = set, .profile = profile, .pilot = pilot, .seconds = 45});
}

double circle(const Flight& flight, double from) {
  const Glimpse at = flight.at(from);
  return std::max(flight.furthest(&Glimpse::x, at.x, from, 45), flight.furthest(&Glimpse::y, at.y, from, 45));
}

// Turns right round, at half a radian a second, as the terminal commands it: to the right from +180 degrees to -180, to
// the left the other way.
Flight turn_round(const std::string& profile, double side) {
  const auto pilot = [side](double time) {
    tasks::PilotCommand command = tests::hover_command(time);
    command.mode_switches = 0;
    command.altitude = time >= 4 ? 0.8 : 0;
    command.yaw = side * std::remainder(std::clamp(0.5 * (time - 9), 0.0, 2 * pi), 2 * pi);
    return command;
  };
  return tests::fly({.set = {"distributers.robostix.link.parameters.dynamics=rigid"},
                     .profile = profile,
                     .pilot = pilot,
                     .seconds = 28});
}

void check_turn(const Flight& flight, double side, double min_rate, double max_rate, double max_ever) {
  double turned = 0, fastest = 0, slowest = 9, ever = 0;
  for (std::size_t i = 1; i < flight.path.size(); ++i) {
    const double step = side * std::remainder(flight.path[i].yaw - flight.path[i - 1].yaw, 2 * pi);
    turned += step;
    ever = std::max(ever, std::abs(step / 0.005));
    if (flight.path[i].time < 13 || flight.path[i].time > 20) continue;  // on the way through 180 degrees
    fastest = std::max(fastest, step / 0.005);
    slowest = std::min(slowest, step / 0.005);
  }
  MESSAGE("turned by " << turned << " rad, between " << slowest << " and " << fastest << " rad/s, at most " << ever
                       << ", lowest " << flight.min(&Glimpse::altitude, 9, 28));
  CHECK(turned == doctest::Approx(2 * pi).scale(0).epsilon(0.01));
  CHECK(fastest < max_rate);
  CHECK(slowest > min_rate);
  CHECK(ever < max_ever);
  CHECK(flight.min(&Glimpse::altitude, 9, 28) > 0.75);
  CHECK(flight.last().state == tasks::FlightState::flying);
}
}  // namespace

TEST_SUITE("tools/javiator_room") {
  TEST_CASE("position mode holds at a yaw of 0, 0.4, 1.5 and 3 rad") {
    for (const double yaw : {0.0, 0.4, 1.5, 3.0}) {
      CAPTURE(yaw);
      const Flight flight = hold_at(yaw, "");
      CHECK(flight.last().state == tasks::FlightState::flying);
      CHECK(std::abs(std::remainder(flight.path.back().yaw - yaw, 2 * pi)) < 0.03);
      CHECK(std::hypot(flight.path.back().x, flight.path.back().y) < 0.05);
      CHECK(circle(flight, 30) < 0.05);
      CHECK(flight.furthest(&Glimpse::altitude, 0.8, 20, 45) < 0.05);
    }
  }

  TEST_CASE("position mode of the original laws holds at a yaw of 0, 0.4, 1.5 and 3 rad") {
    for (const double yaw : {0.0, 0.4, 1.5, 3.0}) {
      CAPTURE(yaw);
      const Flight flight = hold_at(yaw, "original");
      CHECK(flight.last().state == tasks::FlightState::flying);
      MESSAGE("within " << circle(flight, 30) << " m, " << flight.path.back().x << ", " << flight.path.back().y);
      CHECK(circle(flight, 30) < 0.15);
      CHECK(std::hypot(flight.path.back().x, flight.path.back().y) < 0.15);
    }
  }

  TEST_CASE("it holds its place whatever its heading was when it took off") {
    for (const std::string heading : {"0.4", "1.5", "3"}) {
      CAPTURE(heading);
      const Flight flight = hold_at(0.3, "", {"distributers.robostix.link.parameters.start.heading=" + heading});
      CHECK(flight.last().state == tasks::FlightState::flying);
      CHECK(std::hypot(flight.path.back().x, flight.path.back().y) < 0.05);
      CHECK(circle(flight, 30) < 0.05);
    }
  }

  TEST_CASE("where a laser sees no wall, the place is lost, and it lands") {
    const Flight flight = hold_at(0, "", {"distributers.robostix.link.parameters.sensors.laser_reach=8.0"});
    CHECK(flight.last().cause == tasks::LandingCause::position_lost);
    CHECK(flight.impact() < 0.5);
  }

  TEST_CASE("through 180 degrees it turns the short way, to either side, as fast as it is commanded") {
    for (const double side : {1.0, -1.0}) check_turn(turn_round("", side), side, 0.49, 0.51, 0.51);
  }
  TEST_CASE("through 180 degrees the original laws turn the short way, to either side, as fast as they are commanded") {
    for (const double side : {1.0, -1.0}) check_turn(turn_round("original", side), side, 0.45, 0.58, 0.8);
  }

  TEST_CASE("it lifts off within half a second of the altitude command") {
    const Flight flight = tests::fly({.pilot = tests::hover_command, .seconds = 5});
    double off = 9;
    for (const Glimpse& g : flight.path)
      if (g.altitude > 0.002) off = std::min(off, g.time);
    MESSAGE("lifts off after " << off - 3 << " s");
    CHECK(off > 3);
    CHECK(off < 3.5);
  }

  TEST_CASE("after a landing that it chose a key that was meant to land does not start it, and a wrong IMU none") {
    const std::string imu = "distributers.robostix.link.parameters.failures.imu.";
    const auto pilot = [](double time) {
      tasks::PilotCommand command = tests::hover_command(time);
      command.state_switches += (time >= 20 ? 1U : 0U) + (time >= 22 ? 1U : 0U) + (time >= 24 ? 1U : 0U);
      return command;
    };
    const Flight flight =
        tests::fly({.set = {imu + "kind=biased", imu + "by=0.3", imu + "at=9s"}, .pilot = pilot, .seconds = 28});
    CHECK(flight.impact() < 0.5);
    CHECK(flight.furthest(&Glimpse::altitude, 0, 20, 28) < 0.002);
    CHECK(flight.furthest(&Glimpse::roll, 0, 20, 28) < 0.01);
    for (const auto& [time, directive] : flight.directives) {
      if (time > 20 && time < 22) CHECK(directive.state == tasks::FlightState::ground);
      if (time > 22.1) CHECK(directive.state == tasks::FlightState::ground);
      if (time > 22.1 && time < 24) CHECK(directive.cause == tasks::LandingCause::imu_lost);
    }
  }
}
