// What finds a weak motor, and a body whose mass, arms and rotors are those of the JAviator's file: each period it is
// sent signals, and answers, over a way that may take time and lose some.
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>

#include "tasks/javiator/motor_watch.h"
#include "tests/tasks/javiator/every_15_ms.h"

namespace jarol::tests {

using namespace jarol::tasks;

// Thrust of hover each turns 1.5 kg with 0.0144 kg m^2 at arms of 0.3 m.
struct Body {
  double p = 0, q = 0;
  std::array<double, 4> signals{8000, 8000, 8000, 8000}, parts{1, 1, 1, 1};

  void run(int steps, const std::array<double, 4>& sent, double roll_torque, double pitch_torque) {
    constexpr double h = 1e-4, each = 0.3 * 1.5 * g_earth / 4 / 0.0144;
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
  bool held = false;      // no new command, and the one before goes out with the next number
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
    ++number;
    if (!held) in.motors = {.signals = sent, .unlocked = true, .number = number};
    MotorWatch::run(param, tick, in, state, out);
    body.run(100, last, roll_torque, pitch_torque);
    signals.push_back(heard ? std::optional(MotorCommand{in.motors.signals, true, number}) : std::nullopt);
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

}  // namespace jarol::tests
