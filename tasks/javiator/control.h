// The helicopter's control laws: position over attitude, and the mixer that turns attitude and lift into signals for
// four motors. Demands are parts of the thrust of hover, so that gains hold for light and heavy vehicles. In their
// equations, SI units and rad: x is north and y east from the place of take-off; phi, theta, psi are roll, pitch and
// the heading from north, ZYX, yaw that since take-off; p, q, r the angular rates in body axes (forward, right, down);
// |x| <= m means that x is limited to -m..m. The laws are this project's; those of the JAviator's own controller
// (github.com/cksystemsgroup/JAviator, gumstix/src) are in original_control.h.
#pragma once

#include <numbers>
#include <string_view>

#include "graph/task.h"
#include "tasks/javiator/approach.h"
#include "tasks/javiator/rotor_law.h"
#include "tasks/values/gains.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

/// How far it leans where it touches the ground without an IMU: the less, the softer its other feet come down; but it
/// drifts with the wind.
struct BlindTouch {
  double lean = 0.6;
  double low = 0.03;
  double over = 0.07;

  static constexpr auto fields() {
    using T = BlindTouch;
    return describe(field<&T::lean>("", "part of the lean that holds its place").in(0, 1),
                    field<&T::low>("m", "altitude down to which its lean falls to that").in(0, 10),
                    field<&T::over>("m", "of altitude, over which it does").in(0.001, 10));
  }
};

/// How it holds its place without an IMU, when sonars show how it leans.
struct BlindHold {
  double kp = 1.4;
  double kd = 4;
  double upwind = 0.3;
  double level_time = 0.13;
  BlindTouch touch{.lean = 0.4, .low = 0.038, .over = 0.059};

  static constexpr auto fields() {
    using B = BlindHold;
    return describe(field<&B::kp>("1/s^2", "acceleration per error of place"),
                    field<&B::kd>("1/s", "acceleration per error of speed"),
                    field<&B::upwind>("s", "speed against the wind as it lands, per acceleration of its drag"),
                    field<&B::level_time>("s", "in which it levels where a foot may stand").in(0.02, 100),
                    field<&B::touch>("", "how it touches the ground"));
  }
};

/// Where it holds a place it follows an approach to it (approach.h), with a_d the acceleration that this demands:
///   a      = a_d + kp (x_d - x) + kd (v_d - v) - drag + trim           m/s^2, for north and east alike
///   trim_dot = ki (x_d - x),                                           |trim| <= max_trim
///   drag_dot = (drag felt - drag) / drag_time
///   phi_d   = atan((cos(psi) a_east - sin(psi) a_north) / g),          |phi_d| <= lean_limit
///   theta_d = -atan((cos(psi) a_north + sin(psi) a_east) / g),         |theta_d| <= lean_limit
/// (a thrust that carries the weight, leaning so, accelerates it by a). Without an IMU kp and kd are blind_kp and
/// blind_kd, or those of by_sonars, and a landing leans less near the ground: by (1 - touch.lean) less from touch.over
/// above touch.low down to that. A landing without a place brakes by
///   a      = -v - drag
/// By hand the pilot's roll and pitch are meant from the heading of take-off:
///   phi_d  = roll cos(yaw) + pitch sin(yaw),   theta_d = pitch cos(yaw) - roll sin(yaw)
/// Standing, and in a landing where a foot may stand by its sonars, it levels:
///   phi_d_dot = -phi_d / stand_time,           theta_d_dot = -theta_d / stand_time
/// there in by_sonars.level_time. Such a landing that holds a place goes against the wind, v_d being less by
/// by_sonars.upwind drag, until it levels and the wind stops it (kp and ki bring it back, so it does for some 3 s):
/// leaning into the wind it touches with its windward foot first, and one that drifts with the wind would be turned
/// over that foot onto the opposite one.
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
    BlindTouch touch{};
    BlindHold by_sonars{};
    double max_trim = 1;
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
                      field<&P::blind_kd>("1/s", "kd then"), field<&P::touch>("", "how it touches the ground then"),
                      field<&P::by_sonars>("", "the same, when sonars do"),
                      field<&P::max_trim>("m/s^2", "acceleration that the integral adds, at most").in(0, 100));
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

/// One axis of attitude, of angle a and rate a_dot: it follows a critically damped model of the second order, whose
/// demand it knows, w being the bandwidth:
///   rate_d = w / 2 (goal - model.angle),            |rate_d| <= rate
///   acceleration = 2 w (rate_d - model.rate),       |acceleration| <= model_part limit effect   (s^2 + 2 w s + w^2)
///   demand = acceleration / effect + kp (model.angle - a) + kd (model.rate - a_dot) + trim,  |demand| <= limit
///   trim_dot = ki (model.angle - a),                |trim| <= trim_part limit; it is added to before it is used
///   given_dot = (demand - given) / spin_time, which cancels a zero at -1 / spin_time: the hull turns more while rotors
///               speed up than by their drag. Without a spin_time it is the demand.
struct TurnGains {
  double bandwidth = 1;
  double effect = 1;
  double kp = 0;
  double kd = 0;
  double ki = 0;
  double limit = 1;
  double spin_time = 0;
  double rate = 20;
  double model_part = 0.8;
  double trim_part = 0.2;

  static constexpr auto fields() {
    using G = TurnGains;
    return describe(field<&G::bandwidth>("rad/s", "of the model followed"),
                    field<&G::effect>("rad/s^2", "angular acceleration per demand"),
                    field<&G::kp>("1/rad", "demand per error"), field<&G::kd>("s/rad", "demand per error of rate"),
                    field<&G::ki>("1/(rad s)", "demand per integral of the error"),
                    field<&G::limit>("", "greatest demand").in(0, 1),
                    field<&G::spin_time>("s", "for which the hull turns more as rotors speed up than by their drag"),
                    field<&G::rate>("rad/s", "greatest, of the model").in(0, 100),
                    field<&G::model_part>("", "of the greatest demand, at most, for what the model takes").in(0, 1),
                    field<&G::trim_part>("", "of it, at most, for what is learnt").in(0, 1));
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

/// TurnGains' law of roll and pitch with p and q, and of yaw with r, as their rates. Where nothing shows how it leans,
/// roll and pitch turn level as their models do, with goal 0 and no error, and yaw keeps its model's angle.
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
    double astray = 0.5;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::lean>("", "roll and pitch"), field<&P::yaw>(),
                      field<&P::contact>("m", "altitude below which lasers do not show how it leans: a foot may stand"),
                      field<&P::astray>("rad", "of yaw, by which it was turned while it stood, or is counted anew"));
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

/// Of a demand of lift, and of roll, pitch and yaw while it flies or lands, each motor has a part:
///   front = lift - yaw + pitch,   right = lift + yaw - roll,   rear = lift - yaw - pitch,   left = lift + yaw + roll
/// and is sent the signal at which it gives that (rotor_law.h), with `effectiveness` the thrust of a weak motor in
/// parts of a sound one's. While rotors change it is more than is due, from 0 to full:
///   due    = full_signal(battery) (part / effectiveness)^(1 / exponent)
///   signal = reached + (due - reached) (1 - e^(-T / quick_lag)) / (1 - e^(-T / lag)),  T the period
///   reached += (signal - reached) (1 - e^(-T / lag))
/// so that a first-order lag of `lag` acts as one of `quick_lag`. Where a weak motor can't give its part at full
/// signal, the two of its pair (front and rear, or right and left) get so much less, and the other pair so much more:
/// roll, pitch and lift stay in balance at the cost of yaw. Mixing and signs are the JAviator's (control.c there).
struct MotorMixer {
  static constexpr std::string_view summary = "gives the demands of thrust and turning to the four motors";
  struct Param {
    double hover = 8000;
    double exponent = 1.415;
    double voltage = 15.887;
    double lag = 0.05;
    double quick_lag = 0.02;
    BatteryScale battery{};
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::hover>("", "signal that hovers").in(1, max_motor_signal),
                      field<&P::exponent>("", "thrust grows with the signal to this power").in(0.1, 10),
                      field<&P::voltage>("V", "of the battery at which it does; a lower one is made up for"),
                      field<&P::lag>("s", "of the rotors"),
                      field<&P::quick_lag>("s", "that they get instead, by more signal than is due while they change"),
                      field<&P::battery>("", "how much more or less signal makes up for another one"));
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
