// The numbers of the helicopter's mixer: each limit and time, at its edge.
#include <doctest/doctest.h>

#include <cmath>

#include "tasks/javiator/control.h"
#include "tests/tasks/javiator/every_15_ms.h"

namespace {
using namespace jarol;
using namespace jarol::tasks;
using namespace std::chrono_literals;

using tests::dt;
using tests::tick;

struct Mixer {
  MotorMixer::Param param{.quick_lag = 0.05};  // signals as they are due
  MotorMixer::State state{};
  MotorMixer::Out out{};
  MotorMixer::In in{.lift = {1}, .directive = {.state = FlightState::flying}, .estimate = {.battery = 15.887}};

  const std::array<double, 4>& run() {
    MotorMixer::run(param, tick, in, state, out);
    return out.motors.signals;
  }
};
}  // namespace

TEST_SUITE("tasks/javiator_control/mixer") {
  TEST_CASE("thrust grows with the signal to the power of 1.415, up to a signal of 16000") {
    Mixer m;
    m.in.lift.thrust = 1.5;
    for (const double signal : m.run()) CHECK(signal == doctest::Approx(8000 * std::pow(1.5, 1 / 1.415)));
    Mixer full;
    full.in.lift.thrust = 4;
    for (const double signal : full.run()) CHECK(signal == 16000);
    Mixer none;
    none.in.lift.thrust = -0.1;
    for (const double signal : none.run()) CHECK(signal == 0);
  }

  TEST_CASE("a battery is made up for from eight tenths to thirteen tenths of the signal; an unknown one is not") {
    const auto signal_at = [](double battery) {
      Mixer m;
      m.in.estimate.battery = battery;
      return m.run()[0];
    };
    CHECK(signal_at(15.887 / 1.29) == doctest::Approx(8000 * 1.29));
    CHECK(signal_at(15.887 / 1.31) == doctest::Approx(8000 * 1.3));
    CHECK(signal_at(15.887 / 0.81) == doctest::Approx(8000 * 0.81));
    CHECK(signal_at(15.887 / 0.79) == doctest::Approx(8000 * 0.8));
    CHECK(signal_at(0) == doctest::Approx(8000));
  }

  TEST_CASE("each demand of turning is shared by the rotors that give it") {
    const auto thrusts = [](TurnDemand turn) {
      Mixer m;
      m.in.turn = turn;
      std::array<double, 4> parts = m.run();
      for (double& part : parts) part = std::pow(part / 8000, 1.415) - 1;
      return parts;
    };
    const auto is = [](const std::array<double, 4>& parts, double front, double right, double rear, double left) {
      CHECK(parts[0] == doctest::Approx(front));
      CHECK(parts[1] == doctest::Approx(right));
      CHECK(parts[2] == doctest::Approx(rear));
      CHECK(parts[3] == doctest::Approx(left));
    };
    is(thrusts({.roll = 0.1}), 0, -0.1, 0, 0.1);
    is(thrusts({.pitch = 0.1}), 0.1, 0, -0.1, 0);
    is(thrusts({.yaw = 0.1}), -0.1, 0.1, -0.1, 0.1);
  }

  TEST_CASE("a weak motor is sent as much more as it gives less") {
    Mixer m;
    m.in.condition = {.weak = Motor::right, .effectiveness = {1, 0.5, 1, 1}};
    const std::array<double, 4>& signals = m.run();
    CHECK(signals[0] == doctest::Approx(8000));
    CHECK(signals[1] == doctest::Approx(8000 * std::pow(2, 1 / 1.415)));
  }

  TEST_CASE("what a weak motor can't give, its pair gives less of and the other pair more: only yaw is lost") {
    Mixer m;
    m.in.condition = {.weak = Motor::front, .effectiveness = {0.3, 1, 1, 1}};
    m.in.turn = {.roll = 0.05, .pitch = 0.1};
    std::array<double, 4> parts = m.run();
    for (std::size_t i = 0; i < 4; ++i) parts[i] = m.in.condition.effectiveness[i] * std::pow(parts[i] / 8000, 1.415);
    // at its full signal a sound motor gives 2.667 times the thrust of hover
    CHECK(parts[0] == doctest::Approx(0.8).epsilon(0.001).scale(0));
    CHECK(parts[0] - parts[2] == doctest::Approx(0.2));
    CHECK(parts[3] - parts[1] == doctest::Approx(0.1));
    CHECK(parts[0] + parts[1] + parts[2] + parts[3] == doctest::Approx(4));
    // one that can is left as it is
    m.in.turn = {.pitch = -0.21};
    parts = m.run();
    CHECK(parts[1] == doctest::Approx(8000));
    CHECK(parts[3] == doctest::Approx(8000));
  }

  TEST_CASE("rotors of 50 ms follow as if they had 20 ms") {
    Mixer m;
    m.param = {};
    m.in.lift.thrust = 0.5;
    const double signal = m.run()[0], due = 8000 * std::pow(0.5, 1 / 1.415);
    // what a rotor with a lag of 50 ms reaches with that signal, one with 20 ms reaches with what is due
    CHECK(signal * (1 - std::exp(-dt / 0.05)) == doctest::Approx(due * (1 - std::exp(-dt / 0.02))));
    CHECK(m.state.reached[0] == doctest::Approx(due * (1 - std::exp(-dt / 0.02))));
  }

  TEST_CASE("only in flight and while landing does it steer") {
    for (const FlightState state : {FlightState::ground, FlightState::starting}) {
      Mixer m;
      m.in.directive.state = state;
      m.in.turn = {0.1, 0.1, 0.1};
      for (const double signal : m.run()) CHECK(signal == doctest::Approx(8000));
    }
  }
}
