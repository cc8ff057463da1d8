// What finds a weak motor, against a body whose mass, arms and rotors are those of the JAviator's file.
#include "tasks/javiator/motor_watch.h"

#include <doctest/doctest.h>

#include <cmath>
#include <deque>
#include <functional>
#include <optional>
#include <random>

#include "tests/tasks/javiator/every_15_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;

using tests::dt;
using tests::gravity;
using tests::tick;

// Thrust of hover each turns 1.5 kg with 0.0144 kg m^2 at arms of 0.3 m.
struct Body {
  double p = 0, q = 0;
  std::array<double, 4> signals{8000, 8000, 8000, 8000}, parts{1, 1, 1, 1};

  void run(int steps, const std::array<double, 4>& sent, double roll_torque, double pitch_torque) {
    constexpr double h = 1e-4, each = 0.3 * 1.5 * gravity / 4 / 0.0144;
    for (int i = 0; i < steps; ++i) {
      std::array<double, 4> thrusts{};
      for (std::size_t m = 0; m < 4; ++m) {
        signals[m] += (sent[m] - signals[m]) * h / 0.05;
        thrusts[m] = parts[m] * std::pow(signals[m] / 8000, 1.415);
      }
      p += h * (each * (thrusts[3] - thrusts[1] + roll_torque) - 3.9 * p);
      q += h * (each * (thrusts[0] - thrusts[2] + pitch_torque) - 3.9 * q);
    }
  }
};

struct Watched {
  MotorWatch::Param param{};
  MotorWatch::State state{};
  MotorWatch::Out out{};
  MotorWatch::In in{.sensors = {.new_imu = true},
                    .estimate = {.altitude = 1, .battery = 15.887, .rates_known = true},
                    .directive = {.state = FlightState::flying}};
  Body body{};
  JaviatorSensors sampled{.new_imu = true}, answer{.new_imu = true};
  std::uint32_t answers = 0, number = 0;
  std::size_t delay = 0;  // periods that signals take, and answers
  std::deque<std::optional<MotorCommand>> signals;
  std::deque<std::optional<JaviatorSensors>> reports;
  double roll_torque = 0, pitch_torque = 0;  // thrust of hover that it would take

  Watched() { run(100); }

  // Signals act after 10 ms and are answered with what was sampled after the answer before; the IMU is sampled 5 ms
  // later. What nobody hears is not answered.
  void period(const std::array<double, 4>& sent, bool heard = true, bool answer_heard = true) {
    while (reports.size() > delay) {
      if (const auto& report = reports.front()) {
        answer = *report;
        answer.answers = ++answers;
      }
      reports.pop_front();
    }
    in.sensors = answer;
    in.motors = {.signals = sent, .unlocked = true, .number = ++number};
    MotorWatch::run(param, tick, in, state, out);
    body.run(100, last, roll_torque, pitch_torque);
    signals.push_back(heard ? std::optional(in.motors) : std::nullopt);
    std::optional<MotorCommand> acts;
    if (signals.size() > delay) {
      acts = signals.front();
      signals.pop_front();
    }
    reports.emplace_back();
    if (acts) {
      sampled.answered = acts->number;
      if (answer_heard) reports.back() = sampled;
      last = acts->signals;
    }
    body.run(50, last, roll_torque, pitch_torque);
    if (acts) sampled = {.p = body.p, .q = body.q, .new_imu = true};
  }
  void run(int periods) {
    for (int i = 0; i < periods; ++i) period({8000, 8000, 8000, 8000});
  }
  // until one is weak; how long that took, 1 s at most
  double seconds_until_weak() {
    double time = 0;
    for (; time < 1 && out.motors.weak == Motor::none; time += dt) run(1);
    return time;
  }

  std::array<double, 4> last{8000, 8000, 8000, 8000};
};
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
    lands.body.parts[0] = 0.5;
    CHECK(lands.seconds_until_weak() < 0.1);
  }

  TEST_CASE("one that fails as it lands is found down to 6 cm by the sonar, and followed above 10 cm") {
    Watched w;
    w.in.directive.state = FlightState::landing;
    w.in.estimate.altitude_known = true;
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
    lower.in.estimate.altitude_known = true;
    lower.in.estimate.altitude = 0.059;
    lower.body.parts[0] = 0.5;
    CHECK(lower.seconds_until_weak() > 0.99);
    lower.in.estimate.altitude = 0.09;
    lower.in.directive.state = FlightState::flying;  // it takes off: what is found has to be followed
    CHECK(lower.seconds_until_weak() > 0.99);
  }

  TEST_CASE("signals that are not heard, and answers that are not, are no motor's fault") {
    std::mt19937 engine(5);
    for (int flight = 0; flight < 20; ++flight) {
      Watched w;
      for (int i = 0; i < 200; ++i) {
        // as after a gust, with a quarter of the signals lost
        const double turn = 4000 * std::sin(0.5 * i) * std::exp(-0.05 * (i % 40));
        w.period({8000 + turn, 8000, 8000 - turn, 8000}, engine() % 4 != 0);
      }
      CHECK(w.out.motors.weak == Motor::none);
    }
  }

  TEST_CASE("however long signals and answers are on their way, it knows what had acted") {
    for (const std::size_t delay : {1, 2, 3}) {
      std::mt19937 engine(3);
      Watched w;
      w.delay = delay;
      w.run(100);
      w.body.parts[0] = 0.5;
      CHECK(w.seconds_until_weak() < 0.1 + 2 * static_cast<double>(delay) * dt);
      Watched sound;
      sound.delay = delay;
      for (int i = 0; i < 2000; ++i) {
        std::array<double, 4> sent{};
        for (double& signal : sent) signal = 4000 + 8000.0 * static_cast<double>(engine()) / 4294967296.0;
        sound.period(sent);
        if (i > 100)
          for (const double evidence : sound.state.evidence) REQUIRE(evidence == 0);
      }
    }
  }

  TEST_CASE(
      "where a tenth is lost on either way, a weak motor is found within three tenths of a second, mostly in one") {
    std::mt19937 engine(5);
    double all = 0;
    const auto heard = [&] { return engine() % 10 != 0; };
    for (int flight = 0; flight < 200; ++flight) {
      Watched w;
      w.delay = 1;
      const auto fly = [&](int periods) {
        int i = 0;
        for (; i < periods && w.out.motors.weak == Motor::none; ++i) {
          const double turn = 2000 * std::sin(0.3 * i);
          const bool signals_heard = heard(), answer_heard = heard();
          w.period({8000 + turn, 8000, 8000 - turn, 8000}, signals_heard, answer_heard);
        }
        return i * dt;
      };
      fly(100);
      REQUIRE(w.out.motors.weak == Motor::none);
      w.body.parts[1] = 0.5;
      const double time = fly(100);
      CHECK(time < 0.3);
      CHECK(w.out.motors.weak == Motor::right);
      all += time;
    }
    const double mean = all / 200;
    CHECK(mean < 0.1);
  }

  TEST_CASE("what one sample has begun, another may end of which is not sure what had acted") {
    Watched w;
    w.body.parts[0] = 0.5;
    while (w.state.evidence[0] == 0) w.run(1);
    CHECK(w.out.motors.weak == Motor::none);
    w.reports.clear();  // an answer is lost
    w.run(2);
    CHECK(w.out.motors.weak == Motor::front);
  }

  TEST_CASE("one sample that nothing explains is no motor's fault") {
    Watched w;
    w.sampled.p += 1;
    w.answer.p += 1;
    w.run(1);
    for (auto& report : w.reports)
      if (report) report->p += 1;
    w.run(10);
    CHECK(w.out.motors.weak == Motor::none);
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
