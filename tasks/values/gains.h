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

/// Gains that the operator sent in flight, if any.
struct ReceivedGains {
  PiddGains gains{};
  bool received = false;

  const PiddGains& value_or(const PiddGains& own) const { return received ? gains : own; }

  static constexpr auto fields() { return describe(field<&ReceivedGains::gains>(), field<&ReceivedGains::received>()); }
};

struct ReceivedSignal {
  double signal = 0;
  bool received = false;

  double value_or(double own) const { return received ? signal : own; }

  static constexpr auto fields() {
    return describe(field<&ReceivedSignal::signal>("", "0 to 16000"), field<&ReceivedSignal::received>());
  }
};

/// What the operator has changed of the laws' gains; what was never sent is as the laws have it.
struct OperatorGains {
  ReceivedGains lean{}, yaw{}, altitude{}, position{};
  ReceivedSignal idle{};

  static constexpr auto fields() {
    using O = OperatorGains;
    return describe(field<&O::lean>("", "of roll and pitch, for mrad and signals"),
                    field<&O::yaw>("", "for mrad and signals"), field<&O::altitude>("", "for mm and signals"),
                    field<&O::position>("", "for mm and mrad"), field<&O::idle>("", "signal that flight starts from"));
  }
};

}  // namespace jarol::tasks
