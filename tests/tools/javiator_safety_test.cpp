// The helicopter lands of its own accord, safely, whatever fails.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/tools/flight.h"

namespace {
using namespace jarol;
using tasks::LandingCause;
using tests::Flight;
using tests::Glimpse;

constexpr double fails_at = 9;  // s, in hover at 1 m

// Which sensor fails how, and why it has to land.
struct Failing {
  std::string sensor, kind, by;
  LandingCause cause;
};

Flight fly_failing(const Failing& f, const std::string& profile = "", double seconds = 18) {
  const std::string path = "distributers.robostix.link.parameters.failures." + f.sensor;
  return tests::fly({.set = {path + ".kind=" + f.kind, path + ".at=9s", path + ".by=" + f.by},
                     .profile = profile,
                     .pilot = tests::hover_command,
                     .seconds = seconds});
}

void check_safe(const Flight& flight, LandingCause cause, double lean = 0.3) {
  CHECK(flight.at(fails_at).altitude == doctest::Approx(1).scale(0).epsilon(0.03));
  CHECK(flight.report.fault_count == 0);
  CHECK(flight.last().state == tasks::FlightState::ground);
  CHECK(flight.last().cause == cause);
  CHECK(std::abs(flight.path.back().altitude) < 0.002);
  CHECK(flight.impact() < 0.5);
  CHECK(flight.furthest(&Glimpse::roll, 0, fails_at, 18) < lean);
  CHECK(flight.furthest(&Glimpse::pitch, 0, fails_at, 18) < lean);
  CHECK(flight.max(&Glimpse::altitude, fails_at, 18) < 1.7);
  CHECK(flight.furthest(&Glimpse::x, 0, fails_at, 18) < 1);
  CHECK(flight.furthest(&Glimpse::y, 0, fails_at, 18) < 1);
  MESSAGE("touches down with " << flight.impact() << " m/s at " << flight.settled(&Glimpse::altitude, 0, 0.01) << " s, "
                               << std::hypot(flight.path.back().x, flight.path.back().y) << " m away");
}

// Hovers until it wants something that a limit forbids.
Flight exceed(const std::string& limit, const std::function<void(tasks::PilotCommand&)>& want) {
  const auto pilot = [&](double time) {
    tasks::PilotCommand command = tests::hover_command(time);
    if (time >= fails_at) want(command);
    return command;
  };
  return tests::fly({.set = {"tasks.logic.parameters." + limit}, .pilot = pilot, .seconds = 20});
}
}  // namespace

TEST_SUITE("tools/javiator_safety") {
  TEST_CASE("it lands safely whichever sensor is lost") {
    check_safe(fly_failing({"sonar", "lost", "0", LandingCause::sonar_lost}), LandingCause::sonar_lost);
    check_safe(fly_failing({"laser_north", "lost", "0", LandingCause::position_lost}), LandingCause::position_lost);
    check_safe(fly_failing({"laser_east", "lost", "0", LandingCause::position_lost}), LandingCause::position_lost);
    check_safe(fly_failing({"bmu", "lost", "0", LandingCause::bmu_lost}), LandingCause::bmu_lost);
    check_safe(fly_failing({"imu", "lost", "0", LandingCause::imu_lost}), LandingCause::imu_lost);
  }

  TEST_CASE("it lands safely whichever sensor is stuck") {
    check_safe(fly_failing({"sonar", "stuck", "0", LandingCause::sonar_lost}), LandingCause::sonar_lost);
    check_safe(fly_failing({"laser_north", "stuck", "0", LandingCause::position_lost}), LandingCause::position_lost);
    check_safe(fly_failing({"laser_east", "stuck", "0", LandingCause::position_lost}), LandingCause::position_lost);
    check_safe(fly_failing({"bmu", "stuck", "0", LandingCause::bmu_lost}), LandingCause::bmu_lost);
    check_safe(fly_failing({"imu", "stuck", "0", LandingCause::imu_lost}), LandingCause::imu_lost);
  }

  TEST_CASE("it lands safely, where it was, whichever motor loses half of its thrust") {
    for (const std::string motor : {"front", "right", "rear", "left"})
      for (const std::string profile : {"", "wind"}) {
        CAPTURE(motor);
        CAPTURE(profile);
        check_safe(fly_failing({motor, "weak", "0.5", LandingCause::motor_weak}, profile), LandingCause::motor_weak,
                   0.45);
      }
  }

  TEST_CASE("after a landing for a weak motor it starts when it is told to, and lands again") {
    const auto pilot = [](double time) {
      tasks::PilotCommand command = tests::hover_command(time);
      command.state_switches += (time >= 16 ? 1U : 0U) + (time >= 17 ? 1U : 0U);
      return command;
    };
    const std::string front = "distributers.robostix.link.parameters.failures.front.";
    const Flight flight =
        tests::fly({.set = {front + "kind=weak", front + "at=9s", front + "by=0.5"}, .pilot = pilot, .seconds = 30});
    const auto directive_at = [&](double time) {
      return std::ranges::find_if(flight.directives, [&](const auto& each) { return each.first >= time; })->second;
    };
    CHECK(directive_at(15).state == tasks::FlightState::ground);
    CHECK(directive_at(15).cause == LandingCause::motor_weak);
    CHECK(directive_at(16.5).cause == LandingCause::none);
    CHECK(flight.max(&Glimpse::altitude, 17, 30) > 0.08);
    CHECK(flight.last().state == tasks::FlightState::ground);
    CHECK(flight.last().cause == LandingCause::motor_weak);
    CHECK(flight.impact() < 0.5);
  }

  TEST_CASE("however far it is told to turn at once, it knows where it is, and lands there") {
    for (const auto& [profile, first, second] :
         {std::tuple{"", 1.5708, -1.5708}, {"", 0.0, 3.0}, {"wind", 1.5708, -1.5708}, {"wind", -1.5708, 2.9}}) {
      const auto turns = [first = first, second = second](double time) {
        tasks::PilotCommand command = tests::hover_command(time);
        command.yaw = time < 9 ? 0 : time < 13 ? first : second;
        if (time >= 19) command.state_switches = 3;
        return command;
      };
      const Flight flight = tests::fly({.profile = profile, .pilot = turns, .seconds = 27});
      CAPTURE(profile);
      CAPTURE(second);
      CHECK(flight.last().state == tasks::FlightState::ground);
      CHECK(flight.last().cause == LandingCause::none);
      CHECK(flight.furthest(&Glimpse::yaw, second, 18.5, 19) < 0.05);
      CHECK(flight.furthest(&Glimpse::x, 0, 9, 27) < 0.5);
      CHECK(flight.furthest(&Glimpse::y, 0, 9, 27) < 0.5);
      CHECK(flight.furthest(&Glimpse::roll, 0, 9, 27) < 0.3);
      CHECK(flight.furthest(&Glimpse::pitch, 0, 9, 27) < 0.3);
      CHECK(flight.impact() < 0.5);
    }
  }

  TEST_CASE("it lands softly, on its feet, when its IMU fails in the climb, before it has learnt what carries it") {
    double worst = 0;
    for (const std::string kind : {"lost", "stuck"})
      for (const std::string at : {"3.8s", "4s", "4.5s", "5s", "6s"})
        for (std::uint64_t seed = 1; seed <= 6; ++seed) {
          INFO(kind << " at " << at << ", seed " << seed);
          const std::string imu = "distributers.robostix.link.parameters.failures.imu.";
          const Flight flight = tests::fly(
              {.set = {"distributers.robostix.link.parameters.dynamics=rigid", imu + "kind=" + kind, imu + "at=" + at},
               .pilot = tests::hover_command,
               .seconds = 20,
               .seed = seed});
          worst = std::max(worst, flight.impact());
          CHECK(flight.impact() < 0.55);
          CHECK(flight.last().state == tasks::FlightState::ground);
          CHECK(std::abs(flight.path.back().roll) < 0.1);
          CHECK(std::abs(flight.path.back().pitch) < 0.1);
        }
    MESSAGE("touches down with " << worst << " m/s at most");
  }

  TEST_CASE("it lands softly, on its feet, when its IMU fails while it turns round") {
    double worst = 0;
    const auto pilot = [](double time) {
      tasks::PilotCommand command = tests::hover_command(time);
      if (time >= 10) command.yaw = M_PI;
      return command;
    };
    for (const std::string kind : {"lost", "stuck", "biased"})
      for (const std::string at : {"10.3s", "11.2s", "11.8s"})
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
          INFO(kind << " at " << at << ", seed " << seed);
          const std::string imu = "distributers.robostix.link.parameters.failures.imu.";
          const Flight flight = tests::fly({.set = {"distributers.robostix.link.parameters.dynamics=rigid",
                                                    imu + "kind=" + kind, imu + "at=" + at, imu + "by=0.3"},
                                            .pilot = pilot,
                                            .seconds = 20,
                                            .seed = seed});
          worst = std::max(worst, flight.impact());
          CHECK(flight.impact() < 0.55);
          CHECK(flight.last().state == tasks::FlightState::ground);
          CHECK(std::abs(flight.path.back().roll) < 0.1);
          CHECK(std::abs(flight.path.back().pitch) < 0.1);
        }
    MESSAGE("touches down with " << worst << " m/s at most");
  }

  TEST_CASE("it lands softly when its sonar sticks on the way down") {
    double worst = 0;
    const auto pilot = [](double time) {
      tasks::PilotCommand command = tests::hover_command(time);
      if (time >= 12) command.state_switches = 3;
      return command;
    };
    for (const std::string at : {"12.5s", "12.8s", "13.3s", "14s", "15s"})
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        INFO("stuck at " << at << ", seed " << seed);
        const std::string sonar = "distributers.robostix.link.parameters.failures.sonar.";
        const Flight flight = tests::fly(
            {.set = {"distributers.robostix.link.parameters.dynamics=rigid", sonar + "kind=stuck", sonar + "at=" + at},
             .pilot = pilot,
             .seconds = 25,
             .seed = seed});
        worst = std::max(worst, flight.impact());
        CHECK(flight.impact() < 0.5);
        CHECK(flight.last().state == tasks::FlightState::ground);
      }
    MESSAGE("touches down with " << worst << " m/s at most");
  }

  TEST_CASE("it lands safely whichever sensor is suddenly far off") {
    check_safe(fly_failing({"sonar", "biased", "0.8", LandingCause::sonar_lost}), LandingCause::sonar_lost);
    check_safe(fly_failing({"laser_north", "biased", "1", LandingCause::position_lost}), LandingCause::position_lost);
    check_safe(fly_failing({"laser_east", "biased", "-1", LandingCause::position_lost}), LandingCause::position_lost);
    check_safe(fly_failing({"bmu", "biased", "60", LandingCause::bmu_lost}), LandingCause::bmu_lost);
    check_safe(fly_failing({"imu", "biased", "0.3", LandingCause::imu_lost}), LandingCause::imu_lost);
  }

  TEST_CASE("it lands safely when a sensor drifts or jumps, and knows which one it is") {
    const auto check = [](const Failing& failing) { check_safe(fly_failing(failing, "", 25), failing.cause); };
    check({"imu", "drifting", "0.02", LandingCause::imu_lost});
    check({"sonar", "drifting", "0.1", LandingCause::sonar_lost});
    check({"sonar", "jumping", "0.25", LandingCause::sonar_lost});
    check({"bmu", "drifting", "2", LandingCause::bmu_lost});
  }

  TEST_CASE("it lands safely when a limit of roll, pitch, yaw or altitude is exceeded") {
    const auto by_hand = [](auto member) {
      return [member](tasks::PilotCommand& command) {
        command.mode_switches = 2;
        command.*member = 0.15;
      };
    };
    CHECK(exceed("roll_limit=0.1", by_hand(&tasks::PilotCommand::roll)).last().cause == LandingCause::roll);
    CHECK(exceed("pitch_limit=0.1", by_hand(&tasks::PilotCommand::pitch)).last().cause == LandingCause::pitch);
    const auto yaw = [](tasks::PilotCommand& command) { command.yaw = 1; };
    check_safe(exceed("yaw_limit=0.5", yaw), LandingCause::yaw);
    const auto altitude = [](tasks::PilotCommand& command) { command.altitude = 2; };
    check_safe(exceed("altitude_limit=1.5", altitude), LandingCause::altitude);
  }

  TEST_CASE("an exceeded roll ends in a landing, not in a drop") {
    const Flight flight = exceed("roll_limit=0.1", [](tasks::PilotCommand& command) {
      command.mode_switches = 2;
      command.roll = 0.15;
    });
    CHECK(flight.last().state == tasks::FlightState::ground);
    CHECK(flight.impact() < 0.5);
    CHECK(flight.furthest(&Glimpse::roll, 0, fails_at, 20) < 0.25);
    CHECK(std::abs(flight.path.back().altitude) < 0.002);
  }

  TEST_CASE("it lands safely when its operator is lost, after 525 ms") {
    const Flight flight = exceed("patience=0.525s", [](tasks::PilotCommand& command) { command.heard = false; });
    check_safe(flight, LandingCause::operator_lost);
    double landing = 0;
    for (const auto& [time, directive] : flight.directives)
      if (directive.state == tasks::FlightState::flying) landing = time;
    CHECK(landing == doctest::Approx(fails_at + 0.525).scale(0).epsilon(0.005));
  }

  TEST_CASE("it lands safely when its battery runs low") {
    const Flight flight = tests::fly({.set = {"distributers.robostix.link.parameters.battery.capacity=0.05 A h",
                                              "tasks.logic.parameters.battery_limit=15.3 V"},
                                      .pilot = tests::hover_command,
                                      .seconds = 30});
    CHECK(flight.last().state == tasks::FlightState::ground);
    CHECK(flight.last().cause == LandingCause::battery_low);
    CHECK(flight.impact() < 0.5);
  }

  TEST_CASE("a shut-down stops the motors at once, whatever that means") {
    const Flight flight = exceed("patience=0.525s", [](tasks::PilotCommand& command) { command.shut_downs = 1; });
    CHECK(flight.last().state == tasks::FlightState::halt);
    CHECK(flight.touch_down() > 2);
  }
}
