// The JAviator's own control laws, as its flight controller's "original" loop has them; the project's control loop and
// its PIDD controller are the source. Gains are those that its terminal ships with, for mrad, mm and motor signals,
// until it sends others; these count at once, whatever the integrals have summed up. Demands leave here in parts of the
// idle signal.
#pragma once

#include <numbers>
#include <string_view>

#include "graph/task.h"
#include "tasks/javiator/trim.h"
#include "tasks/values/gains.h"
#include "tasks/values/javiator.h"

namespace jarol::tasks {

struct PiddState {
  double integral = 0, goal = 0;

  static constexpr auto fields() {
    return describe(field<&PiddState::integral>("", "of the error"),
                    field<&PiddState::goal>("", "of the period before"));
  }
};

struct OriginalLogic {
  static constexpr std::string_view summary = "switches states as the JAviator's controller";
  struct Param {
    double patience = 0.525;
    double idle = 8000;
    double rev_step = 50;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::patience>("s", "without the operator, before the motors stop"),
                      field<&P::idle>("", "signal that flight starts from").in(0, max_motor_signal),
                      field<&P::rev_step>("", "growth of signals a period until then"));
    }
  };
  struct In {
    FlightEstimate estimate{};
    PilotCommand command{};
    LiftDemand lift{};
    MotorCondition motors{};
    OperatorGains gains{};
    static constexpr auto fields() {
      return describe(field<&In::estimate>("", "for the trim alone: nothing makes it land"), field<&In::command>(),
                      field<&In::lift>("", "not looked at"), field<&In::motors>("", "not looked at"),
                      field<&In::gains>("", "the idle signal of them"));
    }
  };
  struct State {
    double unheard = 0, revs = 0;
    std::uint32_t state_switches = 0, shut_downs = 0;
    TrimKeys trim{};
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::unheard>("s", "the operator was heard"), field<&S::revs>("", "signals reached"),
                      field<&S::state_switches>("", "of the operator, up to now"),
                      field<&S::shut_downs>("", "likewise"), field<&S::trim>("", "likewise"));
    }
  };
  struct Out {
    FlightDirective directive{};
    static constexpr auto fields() { return describe(field<&Out::directive>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

struct OriginalPosition {
  static constexpr std::string_view summary = "holds a place, or leans as commanded, as the JAviator's controller";
  struct Param {
    PiddGains gains{.kp = 0.21, .ki = 0.03, .kd = -0.06, .kdd = 0.001};
    double lean_limit = 0.3;
    double regularity = 1000;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::gains>("", "for mm and mrad"),
                      field<&P::lean_limit>("rad", "when it holds a place").in(0, std::numbers::pi / 2),
                      field<&P::regularity>("", "periods between corrections, times the error in mm and one more"));
    }
  };
  struct In {
    FlightEstimate estimate{};
    FlightDirective directive{};
    OperatorGains gains{};
    static constexpr auto fields() {
      return describe(field<&In::estimate>(), field<&In::directive>(), field<&In::gains>());
    }
  };
  struct State {
    double integral_x = 0, integral_y = 0;
    double roll = 0, pitch = 0;
    std::uint32_t waited_x = 0, waited_y = 0;
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::integral_x>("mm s"), field<&S::integral_y>("mm s"),
                      field<&S::roll>("mrad", "that holds the place"), field<&S::pitch>("mrad"),
                      field<&S::waited_x>("", "periods since the last correction"), field<&S::waited_y>());
    }
  };
  struct Out {
    AttitudeGoal goal{};
    static constexpr auto fields() { return describe(field<&Out::goal>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

struct OriginalAttitude {
  static constexpr std::string_view summary = "turns to a commanded roll, pitch and yaw as the JAviator's controller";
  struct Param {
    PiddGains lean{.kp = 1.7, .ki = 0, .kd = 0.5, .kdd = -0.07};
    PiddGains yaw{.kp = 1.5, .ki = 0, .kd = 0.5, .kdd = 0};
    double idle = 8000;
    static constexpr auto fields() {
      using P = Param;
      return describe(field<&P::lean>("", "of roll and pitch, for mrad and signals"),
                      field<&P::yaw>("", "for mrad and signals"),
                      field<&P::idle>("", "signal that flight starts from").in(0, max_motor_signal));
    }
  };
  struct In {
    FlightEstimate estimate{};
    AttitudeGoal goal{};
    OperatorGains gains{};
    static constexpr auto fields() { return describe(field<&In::estimate>(), field<&In::goal>(), field<&In::gains>()); }
  };
  struct State {
    PiddState roll{}, pitch{}, yaw{};
    double p = 0, q = 0, r = 0;
    static constexpr auto fields() {
      using S = State;
      return describe(field<&S::roll>(), field<&S::pitch>(), field<&S::yaw>(),
                      field<&S::p>("mrad/s", "rate of roll, of the period before"), field<&S::q>("mrad/s", "of pitch"),
                      field<&S::r>("mrad/s", "of yaw"));
    }
  };
  struct Out {
    TurnDemand turn{};
    static constexpr auto fields() { return describe(field<&Out::turn>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

struct OriginalAltitude {
  static constexpr std::string_view summary = "holds a commanded altitude as the JAviator's controller";
  struct Param {
    PiddGains gains{.kp = 1.5, .ki = 0.5, .kd = 1.5, .kdd = 0.05};
    double idle = 8000;
    static constexpr auto fields() {
      return describe(field<&Param::gains>("", "for mm and signals"),
                      field<&Param::idle>("", "signal that flight starts from").in(0, max_motor_signal));
    }
  };
  struct In {
    FlightEstimate estimate{};
    FlightDirective directive{};
    OperatorGains gains{};
    static constexpr auto fields() {
      return describe(field<&In::estimate>(), field<&In::directive>(), field<&In::gains>());
    }
  };
  struct State {
    PiddState z{};
    static constexpr auto fields() { return describe(field<&State::z>()); }
  };
  struct Out {
    LiftDemand lift{};
    static constexpr auto fields() { return describe(field<&Out::lift>()); }
  };
  static void run(const Param& p, const Tick& tick, const In& in, State& state, Out& out);
};

struct OriginalMixer {
  static constexpr std::string_view summary = "gives demands to the four motors as the JAviator's controller";
  struct Param {
    double idle = 8000;
    double rev_step = 50;
    static constexpr auto fields() {
      return describe(field<&Param::idle>("", "signal that flight starts from").in(0, max_motor_signal),
                      field<&Param::rev_step>("", "change of signals a period before and after flight"));
    }
  };
  struct In {
    TurnDemand turn{};
    LiftDemand lift{};
    FlightDirective directive{};
    FlightEstimate estimate{};
    MotorCondition condition{};
    static constexpr auto fields() {
      return describe(field<&In::turn>(), field<&In::lift>(), field<&In::directive>(),
                      field<&In::estimate>("", "not looked at"), field<&In::condition>("", "not looked at"));
    }
  };
  struct Out {
    MotorCommand motors{};
    static constexpr auto fields() { return describe(field<&Out::motors>()); }
  };
  static void run(const Param& p, const Tick&, const In& in, Out& out);
};

}  // namespace jarol::tasks
