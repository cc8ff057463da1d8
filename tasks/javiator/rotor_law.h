// Thrust of one of the helicopter's rotors by the signal that its motor is sent.
#pragma once

#include <algorithm>
#include <cmath>

#include "graph/values/describe.h"

namespace jarol::tasks {

/// By how much more or less signal another battery than that of the reference voltage is made up for.
struct BatteryScale {
  double min = 0.8;
  double max = 1.3;

  static constexpr auto fields() {
    using B = BatteryScale;
    return describe(field<&B::min>("", "times the signal, at least").in(0.1, 1),
                    field<&B::max>("", "times the signal, at most").in(1, 10));
  }
};

/// Thrust in parts of that of hover: thrust = (signal / hover')^exponent, hover' = hover voltage / battery, from
/// scale.min to scale.max times hover; hover itself by a battery that nobody has measured (0 V).
struct RotorLaw {
  double hover;     // signal
  double exponent;  // thrust grows with the signal to this power
  double voltage;   // V, at which it hovers with that signal
  BatteryScale scale;

  double full_signal(double battery) const {
    return battery > 0 ? hover * std::clamp(voltage / battery, scale.min, scale.max) : hover;
  }
  double signal(double thrust, double battery) const {
    return full_signal(battery) * std::pow(std::max(thrust, 0.0), 1 / exponent);
  }
  double thrust(double signal, double battery) const { return std::pow(signal / full_signal(battery), exponent); }
};

}  // namespace jarol::tasks
