// Gains of the JAviator's own control laws, as its terminal sends them.
#pragma once

#include "graph/values/describe.h"

namespace jarol::tasks {

/// kp e + ki int(e) + kd (rate of the goal - velocity) + kdd acceleration.
struct PiddGains {
  double kp = 0, ki = 0, kd = 0, kdd = 0;

  static constexpr auto fields() {
    using G = PiddGains;
    return describe(field<&G::kp>(), field<&G::ki>("1/s"), field<&G::kd>("s"), field<&G::kdd>("s^2"));
  }
};

/// Gains that were told in flight, or not.
struct ToldGains {
  PiddGains gains{};
  bool told = false;

  const PiddGains& value_or(const PiddGains& own) const { return told ? gains : own; }

  static constexpr auto fields() { return describe(field<&ToldGains::gains>(), field<&ToldGains::told>()); }
};

struct ToldSignal {
  double signal = 0;
  bool told = false;

  double value_or(double own) const { return told ? signal : own; }

  static constexpr auto fields() {
    return describe(field<&ToldSignal::signal>("", "0 to 16000"), field<&ToldSignal::told>());
  }
};

/// What the operator has changed of the laws' gains; what was never told is as the laws have it.
struct OperatorGains {
  ToldGains lean{}, yaw{}, altitude{}, position{};
  ToldSignal idle{};

  static constexpr auto fields() {
    using O = OperatorGains;
    return describe(field<&O::lean>("", "of roll and pitch, for mrad and signals"),
                    field<&O::yaw>("", "for mrad and signals"), field<&O::altitude>("", "for mm and signals"),
                    field<&O::position>("", "for mm and mrad"), field<&O::idle>("", "signal that flight starts from"));
  }
};

}  // namespace jarol::tasks
