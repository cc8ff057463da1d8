// The submarine's control laws: depth over pitch, heading over yaw rate, speed, and the fins that carry out the first
// two. The loops are those of DUNE's autopilot (github.com/LSTS/dune, src/Control/AUV and src/DUNE/Control), changed
// where its own runs show an error that stays or a windup. In their equations, SI units and rad: z is the depth in NED,
// positive down; phi, theta, psi are roll, pitch and yaw, ZYX; u, v, w and p, q, r the velocity through the water and
// the angular rates in body axes, forward, right, down; |x| <= m means that x is limited to -m..m. Integrals are used
// before the period is added to them.
#pragma once

#include <string_view>

#include "graph/math/geometry.h"
#include "graph/task.h"
#include "tasks/values/lauv.h"

namespace jarol::tasks {

/// Beyond which nothing steers: a propeller that does not do what it is sent drives the hull astern.
struct DrivenAstern {
  double speed = 0.4;
  double time = 1.5;
  static constexpr auto fields() {
    using A = DrivenAstern;
    return describe(
        field<&A::speed>("m/s", "astern, averaged").in(0, 10),
        field<&A::time>("s", "of that average, some waves: who rests in waves moves to and fro").in(0, 100));
  }
};

/// DUNE's Attitude: a PD law of depth commands a pitch, and one of pitch a fin angle; positive is nose up.
///   e       = setpoint.depth - z
///   z_dot   = -u sin(theta) + v cos(theta) sin(phi) + w cos(theta) cos(phi)
///   theta_d = -kp e + kd z_dot + pitch_trim,                                |theta_d| <= limit
///   pitch_trim_dot = -ki e while |e| < reach,                       |pitch_trim| <= min(limit, within kp reach)
///   moment  = pitch_kp (theta_d - theta) - pitch_kd theta_dot,              |moment| <= fin_limit
///   theta_dot = q cos(phi) - r sin(phi)
/// The integral is this project's: DUNE has none set for its simulator, and stays 5 cm above a depth of 3 m there.
/// Driven astern by a propeller that does not obey (u, averaged over astern.time, < -astern.speed) nothing steers:
/// moment = fin_limit, see vehicles/failures.md.
struct DepthControl {
  static constexpr std::string_view summary = "holds a commanded depth with the stern planes";
  struct Param {
    double kp = 0.45;
    double kd = 0.45;
    double ki = 0.05;
    double reach = 0.5;
    double within = 0.9;
    double limit = 25 * degree;
    double pitch_kp = 1.5;
    double pitch_kd = 1.1;
    double fin_limit = 25 * degree;
    DrivenAstern astern{};
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::kp>("rad/m", "pitch per depth error").in(0, 10),
                      field<&P::kd>("rad s/m", "pitch per rate of depth").in(0, 10),
                      field<&P::ki>("rad/(m s)", "pitch per integral of depth error").in(0, 10),
                      field<&P::reach>("m", "depth error below which the integral works"),
                      field<&P::within>("", "part of that reach that the integral may make up for").in(0, 1),
                      field<&P::limit>("rad", "greatest pitch demanded").in(0, 90 * degree),
                      field<&P::pitch_kp>("", "fin angle per pitch error").in(0, 100),
                      field<&P::pitch_kd>("s", "fin angle per pitch rate").in(0, 100),
                      field<&P::fin_limit>("rad", "greatest fin angle demanded").in(0, max_fin_angle),
                      field<&P::astern>());
    }
  };
  struct In {
    Motion motion{};
    Setpoint setpoint{};
    static constexpr auto fields() { return describe(field<&In::motion>(), field<&In::setpoint>()); }
  };
  struct State {
    double pitch_trim = 0, surge = 0;
    static constexpr auto fields() {
      return describe(field<&State::pitch_trim>("rad", "pitch that holds the depth, learnt by the integral"),
                      field<&State::surge>("m/s", "averaged over some waves"));
    }
  };
  struct Out {
    Moment moment{};
    static constexpr auto fields() { return describe(field<&Out::moment>("", "about the pitch axis, nose up")); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

/// DUNE's Attitude with a rate of yaw between heading and fins; positive is to starboard.
///   r_d    = kp wrapped(setpoint.heading - psi), or setpoint.rate where a rate is commanded,   |r_d| <= rate_limit
///   moment = rate_kp (r_d - r),                                                            |moment| <= fin_limit
/// Driven astern, as of DepthControl: moment = fin_limit.
struct HeadingControl {
  static constexpr std::string_view summary = "turns to a commanded heading with the rudders";
  struct Param {
    double kp = 0.8;
    double rate_limit = 20 * degree;
    double rate_kp = 1.2;
    double fin_limit = 25 * degree;
    DrivenAstern astern{};
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::kp>("1/s", "yaw rate per heading error").in(0, 100),
                      field<&P::rate_limit>("rad/s", "greatest yaw rate demanded").in(0, 360 * degree),
                      field<&P::rate_kp>("s", "fin angle per error of yaw rate").in(0, 100),
                      field<&P::fin_limit>("rad", "greatest fin angle demanded").in(0, max_fin_angle),
                      field<&P::astern>());
    }
  };
  struct In {
    Motion motion{};
    Setpoint setpoint{};
    static constexpr auto fields() { return describe(field<&In::motion>(), field<&In::setpoint>()); }
  };
  struct State {
    double surge = 0;
    static constexpr auto fields() { return describe(field<&State::surge>("m/s", "averaged over some waves")); }
  };
  struct Out {
    Moment moment{};
    static constexpr auto fields() { return describe(field<&Out::moment>("", "about the yaw axis, to starboard")); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

/// The propeller's actuation, 1 being full speed ahead; where a thrust is commanded it is that, from -1 to 1.
///   e         = setpoint.speed - u
///   actuation = feed_forward setpoint.speed + kp e + integral,   from 0 to 1; 0 where the speed commanded is not above
///   0 integral_dot = ki e while the actuation is not at a bound
/// This project's: DUNE commands revolutions with a slew, and overshoots in its simulator.
struct SpeedControl {
  static constexpr std::string_view summary = "holds a commanded speed with the propeller";
  struct Param {
    double feed_forward = 0.55;
    double kp = 0.8;
    double ki = 0.1;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::feed_forward>("s/m", "actuation per commanded speed").in(0, 100),
                      field<&P::kp>("s/m", "actuation per speed error").in(0, 100),
                      field<&P::ki>("1/m", "actuation per integral of speed error, held while saturated").in(0, 100));
    }
  };
  struct In {
    Motion motion{};
    Setpoint setpoint{};
    static constexpr auto fields() { return describe(field<&In::motion>(), field<&In::setpoint>()); }
  };
  struct State {
    double integral = 0;
    static constexpr auto fields() { return describe(field<&State::integral>("", "part of the actuation")); }
  };
  struct Out {
    Thrust thrust{};
    static constexpr auto fields() { return describe(field<&Out::thrust>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

/// DUNE's Allocator without roll: fins (bottom, port, starboard, top), in rad, are (-yaw, -pitch, -pitch, -yaw) by the
/// moments of HeadingControl and DepthControl, which are fin angles.
struct FinAllocator {
  static constexpr std::string_view summary =
      "gives the demands of pitch and yaw to the four fins, the thrust to the propeller";
  struct In {
    Moment pitch{};
    Moment yaw{};
    Thrust thrust{};
    static constexpr auto fields() { return describe(field<&In::pitch>(), field<&In::yaw>(), field<&In::thrust>()); }
  };
  struct Out {
    Actuation actuation{};
    static constexpr auto fields() { return describe(field<&Out::actuation>()); }
  };
  static void run(const Tick&, const In& in, Out& out);
};

struct LauvReport {
  static constexpr std::string_view summary =
      "reports depth, pitch, heading, speed, alarm and whether fins are checked to the operator";
  struct In {
    Motion motion{};
    Condition condition{};
    static constexpr auto fields() { return describe(field<&In::motion>(), field<&In::condition>()); }
  };
  struct Out {
    VehicleReport report{};
    static constexpr auto fields() { return describe(field<&Out::report>()); }
  };
  static void run(const Tick&, const In& in, Out& out);
};

struct LauvForward {
  static constexpr std::string_view summary =
      "passes motion to the operator and the operator's actuation to the vehicle";
  struct In {
    Motion motion{};
    Actuation actuation{};
    static constexpr auto fields() { return describe(field<&In::motion>(), field<&In::actuation>()); }
  };
  struct Out {
    Motion motion{};
    Actuation actuation{};
    static constexpr auto fields() { return describe(field<&Out::motion>(), field<&Out::actuation>()); }
  };
  static void run(const Tick&, const In& in, Out& out);
};

}  // namespace jarol::tasks
