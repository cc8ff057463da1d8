// The helicopter's control laws: position over attitude, and the mixer that turns attitude and lift into signals for
// four motors. Demands are parts of the thrust of hover, so that gains hold for light and heavy vehicles.
#pragma once

#include <numbers>
#include <string_view>

#include "graph/task.h"
#include "tasks/javiator/approach.h"
#include "tasks/values/gains.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

struct PositionControl {
  static constexpr std::string_view summary = "holds a place by leaning towards it, or leans as the pilot says";
  struct Param {
    double kp = 4.0;
    double kd = 3.6;
    double ki = 0.3;
    double drag_time = 0.1;
    ApproachLimits approach{.bandwidth = 1.6, .speed = 2.5, .acceleration = 2.5, .jerk = 12, .lag = 0.2};
    double lean_limit = 0.4;
    double stand_time = 0.3;
    double blind_kp = 0.6;
    double blind_kd = 1.5;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::kp>("1/s^2", "acceleration per error of place"),
                      field<&P::kd>("1/s", "acceleration per error of speed"),
                      field<&P::ki>("1/s^3", "acceleration per integral of the error of place"),
                      field<&P::drag_time>("s", "over which the drag that is leant against is averaged"),
                      field<&P::approach>("", "to a new place"),
                      field<&P::lean_limit>("rad", "greatest roll and pitch demanded").in(0, std::numbers::pi / 2),
                      field<&P::stand_time>("s", "in which it levels where it stands").in(0.02, 100),
                      field<&P::blind_kp>("1/s^2", "kp when lasers show how it leans, slower than an IMU"),
                      field<&P::blind_kd>("1/s", "kd then"));
    }
  };
  struct In {
    FlightEstimate estimate{};
    FlightDirective directive{};
    OperatorGains gains{};
    static constexpr auto fields() {
      return describe(field<&In::estimate>(), field<&In::directive>(),
                      field<&In::gains>("", "of other laws: not looked at"));
    }
  };
  struct State {
    Approach x{}, y{};
    double drag_x = 0, drag_y = 0;
    double trim_x = 0, trim_y = 0;
    bool holding = false;
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::x>(), field<&S::y>(), field<&S::drag_x>("m/s^2", "averaged"),
                      field<&S::drag_y>("m/s^2"), field<&S::trim_x>("m/s^2", "that holds the place, learnt"),
                      field<&S::trim_y>("m/s^2"), field<&S::holding>("", "a place"));
    }
  };
  struct Out {
    AttitudeGoal goal{};
    static constexpr auto fields() { return describe(field<&Out::goal>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

/// One axis of attitude: it follows a critically damped model of the second order, whose effort it knows.
struct TurnGains {
  double bandwidth = 1;
  double effect = 1;
  double kp = 0;
  double kd = 0;
  double ki = 0;
  double limit = 1;
  double spin_time = 0;
  double rate = 20;

  static constexpr auto fields() {
    using G = TurnGains;
    return describe(field<&G::bandwidth>("rad/s", "of the model followed"),
                    field<&G::effect>("rad/s^2", "angular acceleration per demand"),
                    field<&G::kp>("1/rad", "demand per error"), field<&G::kd>("s/rad", "demand per error of rate"),
                    field<&G::ki>("1/(rad s)", "demand per integral of the error"),
                    field<&G::limit>("", "greatest demand").in(0, 1),
                    field<&G::spin_time>("s", "for which the hull turns more as rotors speed up than by their drag"),
                    field<&G::rate>("rad/s", "greatest, of the model").in(0, 100));
  }
};

struct TurnModel {
  double angle = 0, rate = 0, trim = 0, given = 0;

  static constexpr auto fields() {
    using M = TurnModel;
    return describe(field<&M::angle>("rad"), field<&M::rate>("rad/s"), field<&M::trim>("", "demand at rest, learnt"),
                    field<&M::given>("", "demand, smoothed"));
  }
};

struct AttitudeControl {
  static constexpr std::string_view summary = "turns to a commanded roll, pitch and yaw";
  struct Param {
    TurnGains lean{.bandwidth = 16, .effect = 153, .kp = 0.35, .kd = 0.09, .ki = 1.5, .limit = 0.5};
    TurnGains yaw{.bandwidth = 4,
                  .effect = 12.3,
                  .kp = 1.0,
                  .kd = 0.55,
                  .ki = 0.1,
                  .limit = 0.25,
                  .spin_time = 0.53,
                  .rate = 1.2};
    double contact = 0.04;
    static constexpr auto fields() {
      using P = Param;
      return describe(
          field<&P::lean>("", "roll and pitch"), field<&P::yaw>(),
          field<&P::contact>("m", "altitude below which lasers do not show how it leans: a foot may stand"));
    }
  };
  struct In {
    FlightEstimate estimate{};
    AttitudeGoal goal{};
    OperatorGains gains{};
    static constexpr auto fields() {
      return describe(field<&In::estimate>(), field<&In::goal>(),
                      field<&In::gains>("", "of other laws: not looked at"));
    }
  };
  struct State {
    TurnModel roll{}, pitch{}, yaw{};
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::roll>(), field<&S::pitch>(), field<&S::yaw>());
    }
  };
  struct Out {
    TurnDemand turn{};
    static constexpr auto fields() { return describe(field<&Out::turn>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

/// A weak motor is sent more. One that can't give what its part of a demand is, at its full signal, keeps the others'
/// balance of roll, pitch and lift at the cost of yaw.
struct MotorMixer {
  static constexpr std::string_view summary = "gives the demands of thrust and turning to the four motors";
  struct Param {
    double hover = 8000;
    double exponent = 1.415;
    double voltage = 15.887;
    double lag = 0.05;
    double quick_lag = 0.02;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::hover>("", "signal that hovers").in(1, max_motor_signal),
                      field<&P::exponent>("", "thrust grows with the signal to this power").in(0.1, 10),
                      field<&P::voltage>("V", "of the battery at which it does; a lower one is made up for"),
                      field<&P::lag>("s", "of the rotors"),
                      field<&P::quick_lag>("s", "that they get instead, by more signal than is due while they change"));
    }
  };
  struct In {
    TurnDemand turn{};
    LiftDemand lift{};
    FlightDirective directive{};
    FlightEstimate estimate{};
    MotorCondition condition{};
    static constexpr auto fields() {
      return describe(field<&In::turn>(), field<&In::lift>(), field<&In::directive>(), field<&In::estimate>(),
                      field<&In::condition>("", "of the motors"));
    }
  };
  struct State {
    std::array<double, 4> reached{};
    static constexpr auto fields() {
      return describe(field<&State::reached>("", "signals that the rotors have followed"));
    }
  };
  struct Out {
    MotorCommand motors{};
    static constexpr auto fields() { return describe(field<&Out::motors>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

struct HelicopterReporter {
  static constexpr std::string_view summary = "reports attitude, altitude, position and state to the operator";
  struct In {
    FlightEstimate estimate{};
    FlightDirective directive{};
    AttitudeGoal goal{};
    MotorCommand motors{};
    JaviatorSensors sensors{};
    static constexpr auto fields() {
      return describe(field<&In::estimate>(), field<&In::directive>(), field<&In::goal>(), field<&In::motors>(),
                      field<&In::sensors>("", "pressure and temperature of the air"));
    }
  };
  struct Out {
    HelicopterReport report{};
    static constexpr auto fields() { return describe(field<&Out::report>()); }
  };
  static void run(const Tick&, const In& in, Out& out);
};

}  // namespace jarol::tasks
