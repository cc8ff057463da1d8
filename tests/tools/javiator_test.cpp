// The helicopter's flights, from the file that users run, with the noise of its sensors: what they have to reach.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "tests/how_many.h"
#include "tests/tools/flight.h"

namespace {
using namespace jarol;
using tests::Flight;
using tests::Glimpse;

constexpr double degree = std::numbers::pi / 180;
constexpr double begin = 12;  // s, when the manoeuvre begins, after a take-off to 1 m

// Some noise helps and some hinders: JAROL_FULL=1 tries more of it.
std::vector<std::uint64_t> seeds() {
  if (!tests::is_full()) return {1};
  return {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
}

using Want = std::function<void(tasks::PilotCommand&)>;

tests::FlightPlan manoeuvre(const Want& want, double seconds, std::uint64_t seed) {
  return {.pilot =
              [want](double time) {
                tasks::PilotCommand command = tests::hover_command(time);
                if (time >= begin) want(command);
                return command;
              },
          .seconds = begin + seconds,
          .seed = seed};
}

// When the value is within the band for good, after the manoeuvre's begin.
double reached_after(const Flight& flight, double Glimpse::*value, double of, double band) {
  return std::max(flight.settled(value, of, band) - begin, 0.0);
}

// By hand it leans or turns by so much: the overshoot as a part of the step.
double overshoot(double tasks::PilotCommand::*command, double Glimpse::*value, double step, std::uint64_t seed) {
  const auto want = [=](tasks::PilotCommand& c) {
    c.mode_switches = 2;
    c.*command = step;
  };
  const Flight flight = tests::fly(manoeuvre(want, 3, seed));
  CHECK(std::abs(flight.at(begin + 2.9).*value - step) < 0.1 * step);
  return flight.max(value, begin, begin + 3) / step - 1;
}

// Wind of 3 m/s from the south with gusts of 0.5 m/s.
const std::vector<std::string> wind = {"distributers.robostix.link.parameters.air.north=3 m/s",
                                       "distributers.robostix.link.parameters.air.gusts=0.5 m/s"};
}  // namespace

TEST_SUITE("tools/javiator") {
  TEST_CASE("the mission takes off, leans, comes back and lands") {
    const Flight flight = tests::fly({});
    CHECK(flight.report.fault_count == 0);
    CHECK(flight.at(13).altitude == doctest::Approx(1).scale(0).epsilon(0.02));
    CHECK(flight.at(15.3).roll == doctest::Approx(0.075).scale(0).epsilon(0.1));
    CHECK(flight.at(28).y == doctest::Approx(3).scale(0).epsilon(0.02));
    CHECK(flight.touch_down() > 0);
    CHECK(flight.impact() < 0.5);
    CHECK(std::abs(flight.path.back().altitude) < 0.001);
    CHECK(flight.last().state == tasks::FlightState::ground);
    CHECK(flight.last().cause == tasks::LandingCause::none);
  }

  TEST_CASE("it takes off to 1 m with less than 10 % overshoot, and hovers there within 2 cm in height and place") {
    for (const std::uint64_t seed : seeds()) {
      const Flight flight = tests::fly({.pilot = tests::hover_command, .seconds = 30, .seed = seed});
      CHECK(flight.max(&Glimpse::altitude, 0, 30) < 1.1);
      CHECK(flight.furthest(&Glimpse::altitude, 1, 9, 30) < 0.02);
      double circle = 0;
      for (const Glimpse& g : flight.path)
        if (g.time > 9) circle = std::max(circle, std::hypot(g.x, g.y));
      MESSAGE("within " << flight.furthest(&Glimpse::altitude, 1, 9, 30) << " m of 1 m, circle of " << circle << " m");
      CHECK(circle < 0.02);
    }
  }

  TEST_CASE("an altitude step from 0.5 to 1.5 m is 99 % done within 4.6 s, without overshoot") {
    for (const std::uint64_t seed : seeds()) {
      tests::FlightPlan plan = manoeuvre([](auto& command) { command.altitude = 1.5; }, 12, seed);
      plan.pilot = [pilot = plan.pilot](double time) {
        tasks::PilotCommand command = pilot(time);
        command.altitude = std::min(command.altitude, time < begin ? 0.5 : 1.5);
        return command;
      };
      const Flight flight = tests::fly(plan);
      const double before = flight.at(begin).altitude, step = 1;
      CHECK(std::abs(before - 0.5) < 0.02);
      const double time = reached_after(flight, &Glimpse::altitude, flight.path.back().altitude, 0.01 * step);
      const double max = flight.max(&Glimpse::altitude, begin, begin + 12);
      MESSAGE("99 % after " << time << " s, at most " << max << " m");
      CHECK(time < 4.6);
      CHECK(max < 1.5 + 0.01 * step);  // what the sonar's noise makes of hover
      CHECK(std::abs(flight.path.back().altitude - 1.5) < 0.02);
    }
  }

  TEST_CASE(
      "a position step of 10 m is 99 % done within 10 s, without overshoot, and loses less than 2 cm of altitude") {
    for (const std::uint64_t seed : seeds()) {
      const Flight flight = tests::fly(manoeuvre([](auto& command) { command.x = -10; }, 20, seed));
      const double time = reached_after(flight, &Glimpse::x, -10, 0.1);
      const double over = -10 - flight.min(&Glimpse::x, begin, begin + 20);
      const double lowest = flight.min(&Glimpse::altitude, begin, begin + 20);
      MESSAGE("99 % after " << time << " s, " << over << " m beyond, lowest " << lowest << " m");
      CHECK(time < 10);
      CHECK(over < 0.02);  // a part of 0.002, as much as the circle of hover
      CHECK(lowest > 0.98);
      CHECK(flight.furthest(&Glimpse::y, 0, begin, begin + 20) < 0.02);
    }
  }

  TEST_CASE("steps of 10, 10 and 20 degrees of roll, pitch and yaw overshoot by less than 15 %") {
    for (const std::uint64_t seed : seeds()) {
      const double roll = overshoot(&tasks::PilotCommand::roll, &Glimpse::roll, 10 * degree, seed);
      const double pitch = overshoot(&tasks::PilotCommand::pitch, &Glimpse::pitch, 10 * degree, seed);
      const double yaw = overshoot(&tasks::PilotCommand::yaw, &Glimpse::yaw, 20 * degree, seed);
      MESSAGE("overshoot " << roll << ", " << pitch << ", " << yaw);
      CHECK(roll < 0.15);
      CHECK(pitch < 0.15);
      CHECK(yaw < 0.15);
    }
  }

  TEST_CASE("it touches down with less than 0.5 m/s and stays where it stands") {
    for (const std::uint64_t seed : seeds()) {
      const Flight flight = tests::fly(manoeuvre([](auto& command) { command.state_switches = 3; }, 12, seed));
      MESSAGE("touches down with " << flight.impact() << " m/s");
      CHECK(flight.touch_down() > 0);
      CHECK(flight.impact() < 0.5);
      CHECK(flight.last().state == tasks::FlightState::ground);
      CHECK(std::hypot(flight.path.back().x, flight.path.back().y) < 0.03);
    }
  }

  TEST_CASE("in wind of 3 m/s with gusts of 0.5 m/s it holds its height within 3 cm, its place within 8 cm") {
    double circle = 0, max = 0;
    for (const std::uint64_t seed : seeds()) {
      const Flight flight = tests::fly({.set = wind, .pilot = tests::hover_command, .seconds = 40, .seed = seed});
      CHECK(flight.furthest(&Glimpse::altitude, 1, 12, 40) < 0.03);
      for (const Glimpse& g : flight.path)
        if (g.time > 12) circle = std::max(circle, std::hypot(g.x, g.y));
      max = std::max(max, flight.max(&Glimpse::altitude, 0, 40));
    }
    MESSAGE("circle of " << circle << " m");
    CHECK(max < 1.1);
    CHECK(circle < 0.08);
    CHECK(circle > 0.02);  // the goal of calm air is out of reach
  }

  TEST_CASE("in that wind it still lands softly") {
    for (const std::uint64_t seed : seeds()) {
      tests::FlightPlan plan = manoeuvre([](auto& command) { command.state_switches = 3; }, 12, seed);
      plan.set = wind;
      const Flight flight = tests::fly(plan);
      CHECK(flight.impact() < 0.5);
      CHECK(flight.last().state == tasks::FlightState::ground);
    }
  }

  TEST_CASE("with three times the noise in its pressure it flies the mission all the same") {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const Flight flight = tests::fly({.set = {"distributers.robostix.link.parameters.dynamics=rigid",
                                                "distributers.robostix.link.parameters.noise.pressure=6 Pa"},
                                        .seed = seed});
      CHECK(flight.at(28).y == doctest::Approx(3).scale(0).epsilon(0.02));
      CHECK(flight.impact() < 0.5);
      CHECK(flight.last().cause == tasks::LandingCause::none);
    }
  }

  TEST_CASE("a range that is wrong by just less than it may jump changes the signals of hover by less than 40 %") {
    const std::string robostix = "distributers.robostix.link.parameters.", sonar = robostix + "failures.sonar.";
    double min_signal = 1, max_signal = 1;
    for (const std::string by : {"0.079", "-0.079"})
      for (std::uint64_t seed = 1; seed <= tests::how_many<std::uint64_t>(5, 50, 1); ++seed) {
        CAPTURE(by);
        CAPTURE(seed);
        const Flight flight =
            tests::fly({.set = {robostix + "dynamics=rigid", sonar + "kind=biased", sonar + "by=" + by,
                                sonar + "at=9 s", sonar + "lasts=0.05 s"},  // one reading
                        .pilot = tests::hover_command,
                        .seconds = 14,
                        .seed = seed});
        double hover = 0;
        int periods = 0;
        for (const auto& [time, motors] : flight.motors) {
          const double mean = std::accumulate(motors.signals.begin(), motors.signals.end(), 0.0) / 4;
          if (time < 8) continue;
          if (time < 9) {
            hover = (periods * hover + mean) / (periods + 1);
            ++periods;
          } else {
            min_signal = std::min(min_signal, mean / hover);
            max_signal = std::max(max_signal, mean / hover);
          }
        }
        CHECK(flight.furthest(&Glimpse::altitude, 1, 9, 14) < 0.03);
        CHECK(flight.last().state == tasks::FlightState::flying);
      }
    MESSAGE("signals of " << min_signal << " to " << max_signal << " times those of hover");
    CHECK(min_signal < 0.9);  // it was heard
    CHECK(min_signal > 0.6);
    CHECK(max_signal < 1.4);
  }

  TEST_CASE("the V2 flies the same mission, and lands as softly") {
    const Flight flight = tests::fly({.profile = "v2"});
    CHECK(flight.at(13).altitude == doctest::Approx(1).scale(0).epsilon(0.02));
    CHECK(flight.at(28).y == doctest::Approx(3).scale(0).epsilon(0.02));
    CHECK(flight.touch_down() > 0);
    CHECK(flight.impact() < 0.5);
    CHECK(flight.last().state == tasks::FlightState::ground);
    CHECK(flight.last().cause == tasks::LandingCause::none);
  }

  TEST_CASE("another seed gives another digest, the same seed the same") {
    const auto digest = [](std::uint64_t seed) {
      return tests::fly({.pilot = tests::hover_command, .seconds = 5, .seed = seed}).report.digest;
    };
    CHECK(digest(0) == digest(0));
    CHECK(digest(0) != digest(1));
  }
}
