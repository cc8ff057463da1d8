// The helicopter in wind: which failures it survives there, and how well it holds its place.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tests/how_many.h"
#include "tests/tools/flight.h"

namespace {
using namespace jarol;
using tasks::FlightState;
using tasks::LandingCause;
using tests::Flight;
using tests::Glimpse;
using Settings = std::vector<std::string>;

const std::string robostix = "distributers.robostix.link.parameters.";

Settings wind_of(double speed, double gusts) {
  return {robostix + "dynamics=rigid", fmt::format("{}air.north={} m/s", robostix, speed),
          fmt::format("{}air.gusts={} m/s", robostix, gusts)};
}

// In 5 m/s of wind, with gusts of 1 m/s.
Flight fly_in_wind(const Settings& failure, std::uint64_t seed, double lands_at, double seconds) {
  Settings set = wind_of(5, 1);
  set.insert(set.end(), failure.begin(), failure.end());
  const auto pilot = [lands_at](double time) {
    tasks::PilotCommand command = tests::hover_command(time);
    if (time >= lands_at) ++command.state_switches;
    return command;
  };
  return tests::fly({.set = set, .pilot = pilot, .seconds = seconds, .seed = seed});
}

Settings failing_at(double at, const std::string& sensor, const std::string& kind, double by = 0) {
  const std::string path = robostix + "failures." + sensor + ".";
  return {path + "kind=" + kind, fmt::format("{}at={} s", path, at), fmt::format("{}by={}", path, by)};
}

double distance(const Flight& flight, double from, double to) {
  double distance = 0;
  for (const Glimpse& g : flight.path)
    if (g.time >= from && g.time <= to) distance = std::max(distance, std::hypot(g.x, g.y));
  return distance;
}

bool is_upright(const Flight& flight) {
  return std::abs(flight.path.back().roll) < 0.1 && std::abs(flight.path.back().pitch) < 0.1;
}

constexpr double never = 1e9;

// Those whose IMU fails in that wind, and how they end.
struct Landings {
  int flights = 0, wrong = 0, hard = 0;
  double max_impact = 0, max_time = 0;

  void fly(const Settings& failure, std::uint64_t seed, double fails_at) {
    CAPTURE(failure.front());
    CAPTURE(seed);
    const Flight flight = fly_in_wind(failure, seed, never, fails_at + 5);
    const double time = flight.settled(&Glimpse::altitude, 0, 0.02) - fails_at;
    ++flights;
    wrong += is_upright(flight) && time < 3 ? 0 : 1;
    hard += flight.impact() < 0.5 ? 0 : 1;
    max_impact = std::max(max_impact, flight.impact());
    max_time = std::max(max_time, time);
    CHECK(flight.last().state != FlightState::flying);
    CHECK(flight.last().cause == LandingCause::imu_lost);
  }
  std::string text() const {
    return fmt::format(
        "{} of {} overturn or take 3 s, {} meet the ground with 0.5 m/s or more, {} m/s at most, after {} s at most",
        wrong, flights, hard, max_impact, max_time);
  }
};
}  // namespace

TEST_SUITE("tools/javiator_wind") {
  TEST_CASE(
      "without an IMU in 5 m/s of wind, from any side, it lands on its feet within 3 s, and touches with less than 0.5 "
      "m/s but in one flight of twelve, and with less than 1 m/s in all") {
    Landings landings;
    for (const std::string kind : {"lost", "stuck"})
      for (int i = 1; i <= tests::how_many(25, 100, 1); ++i) {
        Settings failure = failing_at(6 + i % 5, "imu", kind);
        const double towards = i;  // rad from north, half of the winds; the others blow north
        if (i % 2 == 1) {
          failure.push_back(fmt::format("{}air.north={} m/s", robostix, 5 * std::cos(towards)));
          failure.push_back(fmt::format("{}air.east={} m/s", robostix, 5 * std::sin(towards)));
        }
        landings.fly(failure, static_cast<std::uint64_t>(i), 6 + i % 5);
      }
    MESSAGE(landings.text());
    CHECK(landings.wrong == 0);
    CHECK(landings.hard <= landings.flights / 12);
    CHECK(landings.max_impact < 1);
  }

  TEST_CASE("by its lasers alone one flight of 25 overturns or takes 3 s, and a third touches with 0.5 m/s or more") {
    Landings landings;
    for (int i = 1; i <= tests::how_many(25, 100, 1); ++i) {
      Settings failure = failing_at(6 + i % 5, "imu", "lost");
      failure.push_back("distributers.robostix.parameters.each_sonar=false");
      landings.fly(failure, static_cast<std::uint64_t>(i), 6 + i % 5);
    }
    MESSAGE(landings.text());
    CHECK(landings.wrong <= landings.flights / 25);
    CHECK(landings.hard <= landings.flights / 3);
  }

  TEST_CASE("in 3 m/s of wind it lands softly, on its feet, when its IMU fails while it turns round") {
    double max_impact = 0;
    const auto pilot = [](double time) {
      tasks::PilotCommand command = tests::hover_command(time);
      if (time >= 9.3) command.yaw = std::numbers::pi;
      return command;
    };
    for (const double wind : {-3.0, 3.0})
      for (std::uint64_t seed = 1; seed <= tests::how_many<std::uint64_t>(4, 40, 1); ++seed) {
        CAPTURE(wind);
        CAPTURE(seed);
        Settings set = wind_of(wind, 0);
        for (const std::string& setting : failing_at(10, "imu", "lost")) set.push_back(setting);
        const Flight flight = tests::fly({.set = set, .pilot = pilot, .seconds = 18, .seed = seed});
        max_impact = std::max(max_impact, flight.impact());
        CHECK(flight.last().state == FlightState::ground);
        CHECK(flight.last().cause == LandingCause::imu_lost);
        CHECK(is_upright(flight));
      }
    MESSAGE("touches with " << max_impact << " m/s at most");
    CHECK(max_impact < 0.5);
  }

  TEST_CASE("with a laser stuck in 5 m/s of wind it lands softly, on its feet, near its place") {
    double max_impact = 0, max_distance = 0;
    for (const std::string laser : {"laser_north", "laser_east"})
      for (std::uint64_t seed = 1; seed <= tests::how_many<std::uint64_t>(4, 50, 1); ++seed) {
        CAPTURE(laser);
        CAPTURE(seed);
        const Flight flight = fly_in_wind(failing_at(9, laser, "stuck"), seed, never, 18);
        max_impact = std::max(max_impact, flight.impact());
        max_distance = std::max(max_distance, distance(flight, 9, 18));
        CHECK(flight.last().state == FlightState::ground);
        CHECK(flight.last().cause == LandingCause::position_lost);
        CHECK(flight.impact() < 0.5);
        CHECK(is_upright(flight));
        CHECK(distance(flight, 9, 18) < 1);
      }
    MESSAGE("meets the ground with " << max_impact << " m/s at most, " << max_distance << " m away at most");
  }

  // gusts push it away where they are more than it may lean against (0.4 rad)
  TEST_CASE(
      "in 8 m/s of wind with gusts of 2 m/s it is blown up to 6 m away and is back within 10 s, or, in one flight of "
      "ten, ends on the ground") {
    constexpr double end = 39;
    const int flights = tests::how_many(6, 50, 1);
    int grounded = 0;
    for (int seed = 1; seed <= flights; ++seed) {
      CAPTURE(seed);
      const Flight flight = tests::fly({.set = wind_of(8, 2),
                                        .pilot = tests::hover_command,
                                        .seconds = end,
                                        .seed = static_cast<std::uint64_t>(seed)});
      if (flight.last().state == FlightState::ground) {
        ++grounded;
        continue;
      }
      double back = 9, max_away = 0, at_end = std::numeric_limits<double>::infinity();
      for (const Glimpse& g : flight.path) {
        if (g.time < 9) continue;
        const double away = std::hypot(g.x, g.y);
        if (away < 0.5) back = g.time;
        max_away = std::max(max_away, g.time - back);
        if (g.time > end - 6) at_end = std::min(at_end, away);
      }
      MESSAGE(distance(flight, 9, end) << " m away at most, by more than 0.5 m for " << max_away
                                       << " s at a time, within " << at_end << " m in the last 6 s");
      CHECK(flight.last().state == FlightState::flying);
      CHECK(distance(flight, 9, end) < 6);
      CHECK(max_away < 10);
      CHECK(at_end < 0.5);
    }
    CHECK(grounded <= flights / 10);
  }

  TEST_CASE(
      "it lands softly in wind whichever sensor is noisy or jumps, and blames another in one flight of 100 at most") {
    struct Failure {
      std::string sensor, kind;
      double by;
      LandingCause cause;
    };
    int flights = 0, wrong = 0;
    double max_impact = 0;
    for (const Failure& f : {Failure{"imu", "noisy", 10, LandingCause::imu_lost},
                             {"sonar", "noisy", 10, LandingCause::sonar_lost},
                             {"laser_north", "noisy", 10, LandingCause::position_lost},
                             {"laser_east", "noisy", 10, LandingCause::position_lost},
                             {"bmu", "noisy", 10, LandingCause::bmu_lost},
                             {"imu", "jumping", 0.3, LandingCause::imu_lost},
                             {"sonar", "jumping", 0.25, LandingCause::sonar_lost},
                             {"laser_north", "jumping", 1, LandingCause::position_lost},
                             {"laser_east", "jumping", 1, LandingCause::position_lost},
                             {"bmu", "jumping", 30, LandingCause::bmu_lost}}) {
      if (tests::tries_less && f.sensor != "sonar") continue;
      for (std::uint64_t seed = 1; seed <= tests::how_many<std::uint64_t>(3, 50, 1); ++seed) {
        CAPTURE(f.sensor);
        CAPTURE(f.kind);
        CAPTURE(seed);
        const Flight flight = fly_in_wind(failing_at(8, f.sensor, f.kind, f.by), seed, 12, 20);
        max_impact = std::max(max_impact, flight.impact());
        CHECK(flight.last().state == FlightState::ground);
        ++flights;
        wrong += flight.last().cause == f.cause || flight.last().cause == LandingCause::none ? 0 : 1;
        CHECK(is_upright(flight));
        CHECK(flight.impact() < 0.5);
        CHECK(distance(flight, 8, 20) < 1);
      }
    }
    MESSAGE("meets the ground with " << max_impact << " m/s at most, " << wrong << " blame another");
    CHECK(wrong <= flights / 100);
  }

  TEST_CASE(
      "10 Pa too much or too little of its pressure are blamed on that, but for one flight of 20 not on its sonar, and "
      "it lands softly") {
    int flights = 0, wrong = 0;
    for (const bool windy : {false, true}) {
      if (tests::tries_less && !windy) continue;
      for (const double at : {9.0, 15.0})
        for (const double by : {10.0, -10.0})
          for (std::uint64_t seed = 1; seed <= tests::how_many<std::uint64_t>(3, 50, 1); ++seed) {
            CAPTURE(windy);
            CAPTURE(at);
            CAPTURE(by);
            CAPTURE(seed);
            Settings set = windy ? wind_of(5, 1) : wind_of(0, 0);
            const Settings failure = failing_at(at, "bmu", "biased", by);
            set.insert(set.end(), failure.begin(), failure.end());
            const Flight flight =
                tests::fly({.set = set, .pilot = tests::hover_command, .seconds = at + 14, .seed = seed});
            ++flights;
            wrong += flight.last().cause == LandingCause::sonar_lost ? 1 : 0;
            CHECK((flight.last().cause == LandingCause::bmu_lost || flight.last().cause == LandingCause::sonar_lost));
            CHECK(flight.last().state == FlightState::ground);
            CHECK(flight.impact() < 0.5);
          }
    }
    MESSAGE(wrong << " of " << flights << " blame their sonar");
    CHECK(wrong <= flights / 20);
  }

  TEST_CASE("a payload that drops and a gust of 5 m/s, both by chance, end no flight, nor blow it away") {
    const std::string payload = "payload={mass: 0.3 kg, at: 8 s, chance: 1}",
                      gust = "air.gust={east: 5 m/s, down: 1 m/s, time: 2 s, at: 8 s, chance: 1}";
    for (const std::string& event : {payload, gust})
      for (std::uint64_t seed = 1; seed <= tests::how_many<std::uint64_t>(4, 50, 1); ++seed) {
        CAPTURE(event);
        CAPTURE(seed);
        const Flight flight = fly_in_wind({robostix + event}, seed, 16, 23);
        CHECK(flight.furthest(&Glimpse::altitude, 1, 8, 16) < 0.1);
        CHECK(distance(flight, 8, 16) < 0.3);
        CHECK(flight.last().state == FlightState::ground);
        CHECK(flight.last().cause == LandingCause::none);
        CHECK(is_upright(flight));
        CHECK(flight.impact() < 0.5);
      }
  }
}
