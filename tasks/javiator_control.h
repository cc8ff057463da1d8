// The helicopter's control laws: position over attitude, altitude over thrust, and the mixer that turns both into
// signals for four motors. Demands are parts of the thrust of hover, so that gains hold for light and heavy vehicles.
#pragma once

#include <string_view>

#include "graph/task.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

/// A goal approached with bounded speed and acceleration, without overshoot.
struct Approach {
  double place = 0, speed = 0, acceleration = 0;

  static constexpr auto fields() {
    using A = Approach;
    return describe(field<&A::place>("m"), field<&A::speed>("m/s"), field<&A::acceleration>("m/s^2"));
  }
};

struct PositionControl {
  static constexpr std::string_view summary = "holds a place by leaning towards it, or leans as the pilot says";
  struct Param {
    double kp = 2.0;
    double kd = 2.4;
    double ki = 0.6;
    double bandwidth = 1.6;
    double speed_limit = 2.5;
    double acceleration_limit = 2.5;
    double lean_limit = 0.35;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::kp>("1/s^2", "acceleration per error of place"),
                      field<&P::kd>("1/s", "acceleration per error of speed"),
                      field<&P::ki>("1/s^3", "acceleration per integral of the error of place"),
                      field<&P::bandwidth>("rad/s", "of the approach to a new place"),
                      field<&P::speed_limit>("m/s", "of the approach"),
                      field<&P::acceleration_limit>("m/s^2", "of the approach"),
                      field<&P::lean_limit>("rad", "greatest roll and pitch demanded"));
    }
  };
  struct In {
    FlightEstimate estimate{};
    FlightDirective directive{};
    static constexpr auto fields() { return describe(field<&In::estimate>(), field<&In::directive>()); }
  };
  struct State {
    Approach x{}, y{};
    double trim_x = 0, trim_y = 0;
    bool holding = false;
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::x>(), field<&S::y>(), field<&S::trim_x>("m/s^2", "that holds the place, learnt"),
                      field<&S::trim_y>("m/s^2"), field<&S::holding>("", "a place"));
    }
  };
  struct Out {
    AttitudeGoal goal{};
    static constexpr auto fields() { return describe(field<&Out::goal>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

struct AttitudeControl {
  static constexpr std::string_view summary = "turns to a commanded roll, pitch and yaw";
  struct Param {
    double kp = 0.19;
    double kd = 0.066;
    double limit = 0.5;
    double yaw_kp = 0.26;
    double yaw_kd = 0.26;
    double yaw_limit = 0.25;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::kp>("1/rad", "demand per error of roll and pitch"),
                      field<&P::kd>("s/rad", "demand per rate of roll and pitch"),
                      field<&P::limit>("", "greatest demand of roll and pitch"),
                      field<&P::yaw_kp>("1/rad", "demand per error of yaw"),
                      field<&P::yaw_kd>("s/rad", "demand per rate of yaw"),
                      field<&P::yaw_limit>("", "greatest demand of yaw"));
    }
  };
  struct In {
    FlightEstimate estimate{};
    AttitudeGoal goal{};
    static constexpr auto fields() { return describe(field<&In::estimate>(), field<&In::goal>()); }
  };
  struct Out {
    TurnDemand turn{};
    static constexpr auto fields() { return describe(field<&Out::turn>()); }
  };
  static void run(const Param& p, const Tick&, const In& in, Out& out);
};

struct AltitudeControl {
  static constexpr std::string_view summary = "takes off softly, holds a commanded altitude, and lands softly";
  struct Param {
    double kp = 7;
    double kd = 5;
    double ki = 4;
    double bandwidth = 2.2;
    double speed_limit = 1;
    double acceleration_limit = 2;
    double idle = 0.5;
    double lift_rate = 0.25;
    double descent = 0.5;
    double touch_speed = 0.2;
    double spin_up = 1.5;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::kp>("1/s^2", "acceleration per error of altitude"),
                      field<&P::kd>("1/s", "acceleration per error of climb"),
                      field<&P::ki>("1/s^3", "acceleration per integral of the error of altitude"),
                      field<&P::bandwidth>("rad/s", "of the approach to a new altitude"),
                      field<&P::speed_limit>("m/s", "of the approach"),
                      field<&P::acceleration_limit>("m/s^2", "of the approach"),
                      field<&P::idle>("", "thrust while standing ready, in parts of that of hover"),
                      field<&P::lift_rate>("1/s", "at which thrust grows until it lifts off"),
                      field<&P::descent>("m/s", "of a landing"), field<&P::touch_speed>("m/s", "of its last part"),
                      field<&P::spin_up>("s", "from rest to idle"));
    }
  };
  struct In {
    FlightEstimate estimate{};
    FlightDirective directive{};
    static constexpr auto fields() { return describe(field<&In::estimate>(), field<&In::directive>()); }
  };
  struct State {
    Approach z{};
    double trim = 0;
    bool lifted = false;
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::z>(), field<&S::trim>("", "thrust at rest, learnt"),
                      field<&S::lifted>("", "it has left the ground"));
    }
  };
  struct Out {
    LiftDemand lift{};
    static constexpr auto fields() { return describe(field<&Out::lift>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

struct MotorMixer {
  static constexpr std::string_view summary = "gives the demands of thrust and turning to the four motors";
  struct Param {
    double hover = 8000;
    double exponent = 1.415;
    double voltage = 15.887;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::hover>("", "signal that hovers"),
                      field<&P::exponent>("", "thrust grows with the signal to this power"),
                      field<&P::voltage>("V", "of the battery at which it does; a lower one is made up for"));
    }
  };
  struct In {
    TurnDemand turn{};
    LiftDemand lift{};
    FlightDirective directive{};
    FlightEstimate estimate{};
    static constexpr auto fields() {
      return describe(field<&In::turn>(), field<&In::lift>(), field<&In::directive>(), field<&In::estimate>());
    }
  };
  struct Out {
    MotorCommand motors{};
    static constexpr auto fields() { return describe(field<&Out::motors>()); }
  };
  static void run(const Param& p, const Tick&, const In& in, Out& out);
};

struct HelicopterReporter {
  static constexpr std::string_view summary = "tells the operator attitude, altitude, position and state";
  struct In {
    FlightEstimate estimate{};
    FlightDirective directive{};
    static constexpr auto fields() { return describe(field<&In::estimate>(), field<&In::directive>()); }
  };
  struct Out {
    HelicopterReport report{};
    static constexpr auto fields() { return describe(field<&Out::report>()); }
  };
  static void run(const Tick&, const In& in, Out& out);
};

}  // namespace jarol::tasks
