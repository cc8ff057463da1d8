// The submarine's control laws: depth over pitch, heading over yaw rate, speed, and the fins that carry out the first
// two. The loops are those of DUNE's autopilot, bettered where its own runs show an error that stays or a windup.
#pragma once

#include <string_view>

#include "graph/math/geometry.h"
#include "graph/task.h"
#include "tasks/values/lauv.h"

namespace jarol::tasks {

struct DepthControl {
  static constexpr std::string_view summary = "holds a commanded depth with the stern planes";
  struct Param {
    double kp = 0.45;
    double kd = 0.45;
    double ki = 0.05;
    double reach = 0.5;
    double limit = 25 * degree;
    double pitch_kp = 1.5;
    double pitch_kd = 1.1;
    double fin_limit = 25 * degree;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::kp>("rad/m", "pitch per depth error").in(0, 10),
                      field<&P::kd>("rad s/m", "pitch per rate of depth").in(0, 10),
                      field<&P::ki>("rad/(m s)", "pitch per integral of depth error").in(0, 10),
                      field<&P::reach>("m", "depth error below which the integral works"),
                      field<&P::limit>("rad", "greatest pitch demanded").in(0, 90 * degree),
                      field<&P::pitch_kp>("", "fin angle per pitch error").in(0, 100),
                      field<&P::pitch_kd>("s", "fin angle per pitch rate").in(0, 100),
                      field<&P::fin_limit>("rad", "greatest fin angle demanded").in(0, max_fin_angle));
    }
  };
  struct In {
    Motion motion{};
    Setpoint setpoint{};
    static constexpr auto fields() { return describe(field<&In::motion>(), field<&In::setpoint>()); }
  };
  struct State {
    double pitch_trim = 0;
    static constexpr auto fields() {
      return describe(field<&State::pitch_trim>("rad", "pitch that holds the depth, learnt by the integral"));
    }
  };
  struct Out {
    Moment moment{};
    static constexpr auto fields() { return describe(field<&Out::moment>("", "about the pitch axis, nose up")); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

struct HeadingControl {
  static constexpr std::string_view summary = "turns to a commanded heading with the rudders";
  struct Param {
    double kp = 0.8;
    double rate_limit = 20 * degree;
    double rate_kp = 1.2;
    double fin_limit = 25 * degree;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::kp>("1/s", "yaw rate per heading error").in(0, 100),
                      field<&P::rate_limit>("rad/s", "greatest yaw rate demanded").in(0, 360 * degree),
                      field<&P::rate_kp>("s", "fin angle per error of yaw rate").in(0, 100),
                      field<&P::fin_limit>("rad", "greatest fin angle demanded").in(0, max_fin_angle));
    }
  };
  struct In {
    Motion motion{};
    Setpoint setpoint{};
    static constexpr auto fields() { return describe(field<&In::motion>(), field<&In::setpoint>()); }
  };
  struct Out {
    Moment moment{};
    static constexpr auto fields() { return describe(field<&Out::moment>("", "about the yaw axis, to starboard")); }
  };
  static void run(const Param& p, const Tick&, const In& in, Out& out);
};

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
  static constexpr std::string_view summary = "reports depth, pitch, heading, speed and alarm to the operator";
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
