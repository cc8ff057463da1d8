// What finds a weak motor, where each signal and each answer is heard at once.
#include <doctest/doctest.h>

#include <functional>
#include <random>

#include "tests/tasks/javiator/watched.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using tests::Watched;
}  // namespace

TEST_SUITE("tasks/javiator_motor_watch") {
  TEST_CASE(
      "each motor that gives half of its thrust is found within a tenth of a second, and how much it gives soon") {
    for (std::size_t i = 0; i < 4; ++i) {
      Watched w;
      w.body.parts[i] = 0.5;
      CHECK(w.seconds_until_weak() < 0.1);
      CHECK(w.out.motors.weak == static_cast<Motor>(i + 1));
      w.run(20);
      for (std::size_t m = 0; m < 4; ++m)
        CHECK(w.out.motors.effectiveness[m] ==
              (m == i ? doctest::Approx(0.5).epsilon(0.02).scale(0) : doctest::Approx(1)));
    }
  }

  TEST_CASE(
      "one that gives nothing counts as giving a tenth, one that recovers as giving all, and it stays the weak one") {
    Watched w;
    w.body.parts[2] = 0;
    w.run(40);
    CHECK(w.out.motors.effectiveness == std::array<double, 4>{1, 1, 0.1, 1});
    w.body.parts[2] = 1;
    w.run(60);
    CHECK(w.out.motors.effectiveness[2] == doctest::Approx(1).epsilon(0.01).scale(0));
    CHECK(w.out.motors.weak == Motor::rear);
  }

  TEST_CASE("whatever sound motors are sent, they turn it as they should") {
    std::mt19937 engine(3);
    Watched w;
    for (int i = 0; i < 2000; ++i) {
      std::array<double, 4> sent{};
      for (double& signal : sent) signal = 4000 + 8000.0 * static_cast<double>(engine()) / 4294967296.0;
      w.period(sent);
      for (const double evidence : w.state.evidence) REQUIRE(evidence == 0);
    }
    CHECK(w.out.motors.weak == Motor::none);
  }

  TEST_CASE("wind that turns it slowly, or about two axes, is no motor; the same at once, about one, would be") {
    Watched slow;
    for (int i = 0; i < 200; ++i) {
      slow.roll_torque = 0.28 * i / 200;
      slow.run(1);
    }
    CHECK(slow.out.motors.weak == Motor::none);
    Watched across;
    across.roll_torque = 0.5;
    across.pitch_torque = -0.4;
    CHECK(across.seconds_until_weak() > 0.99);
    Watched sudden;
    sudden.roll_torque = 0.28;
    CHECK(sudden.seconds_until_weak() < 0.2);
    CHECK(sudden.out.motors.weak == Motor::right);
  }

  TEST_CASE("near the ground, on it, and without rates nothing is found") {
    const std::function<void(MotorWatch::In&)> changes[] = {
        [](MotorWatch::In& in) { in.estimate.altitude = 0.09; },
        [](MotorWatch::In& in) { in.estimate.rates_known = false; },
        [](MotorWatch::In& in) { in.directive.state = FlightState::ground; }};
    for (const auto& change : changes) {
      Watched w;
      change(w.in);
      w.body.parts[0] = 0.5;
      w.run(60);
      CHECK(w.out.motors.weak == Motor::none);
    }
    Watched lands;
    lands.in.directive.state = FlightState::landing;
    lands.in.estimate.altitude_confirmed = true;
    lands.body.parts[0] = 0.5;
    CHECK(lands.seconds_until_weak() < 0.1);
  }

  TEST_CASE("one that fails as it lands is found down to 6 cm by the sonar, and followed above 10 cm") {
    Watched w;
    w.in.directive.state = FlightState::landing;
    w.in.estimate.altitude_known = w.in.estimate.altitude_confirmed = true;
    w.in.estimate.altitude = 0.061;
    w.body.parts[0] = 0.5;
    CHECK(w.seconds_until_weak() < 0.1);
    const double found = w.out.motors.effectiveness[0];
    w.run(20);
    CHECK(w.out.motors.effectiveness[0] == found);
    w.in.estimate.altitude = 0.101;
    w.run(20);
    CHECK(w.out.motors.effectiveness[0] == doctest::Approx(0.5).epsilon(0.02).scale(0));
    Watched lower;
    lower.in.directive.state = FlightState::landing;
    lower.in.estimate.altitude_known = lower.in.estimate.altitude_confirmed = true;
    lower.in.estimate.altitude = 0.059;
    lower.body.parts[0] = 0.5;
    CHECK(lower.seconds_until_weak() > 0.99);
    lower.in.estimate.altitude = 0.09;
    lower.in.directive.state = FlightState::flying;  // it takes off: what is found has to be followed
    CHECK(lower.seconds_until_weak() > 0.99);
  }

  TEST_CASE("in a landing whose altitude nothing confirms the ground is no motor's fault, but a weak one is followed") {
    Watched w;
    w.in.directive.state = FlightState::landing;
    w.in.estimate.altitude = 0.7;  // it stands
    w.roll_torque = 0.5;
    CHECK(w.seconds_until_weak() > 0.99);
    Watched flies;
    flies.in.estimate.altitude = 0.7;
    flies.body.parts[0] = 0.5;
    REQUIRE(flies.seconds_until_weak() < 0.1);
    flies.in.directive.state = FlightState::landing;
    flies.run(20);
    CHECK(flies.out.motors.effectiveness[0] == doctest::Approx(0.5).epsilon(0.02).scale(0));
    flies.body.parts[0] = 0.4;
    flies.run(20);
    CHECK(flies.out.motors.effectiveness[0] == doctest::Approx(0.4).epsilon(0.02).scale(0));
  }

  TEST_CASE("when the operator has acknowledged the landing each motor is tried anew") {
    Watched w;
    w.body.parts[0] = 0.5;
    w.run(40);
    w.in.directive = {.state = FlightState::ground, .cause = LandingCause::motor_weak};
    w.run(40);
    CHECK(w.out.motors.weak == Motor::front);
    w.in.directive.cause = LandingCause::none;
    w.run(1);
    CHECK(w.out.motors.weak == Motor::none);
    CHECK(w.out.motors.effectiveness == std::array<double, 4>{1, 1, 1, 1});
  }
}
