// Thrust of one of the helicopter's rotors by the signal that its motor is sent.
#pragma once

#include <algorithm>
#include <cmath>

namespace jarol::tasks {

/// Thrust in parts of that of hover: thrust = (signal / hover')^exponent, hover' = hover voltage / battery. Another
/// battery than that of the reference voltage is made up for by 0.8 to 1.3 times the signal; one that nobody has
/// measured (0 V) is not.
struct RotorLaw {
  double hover;     // signal
  double exponent;  // thrust grows with the signal to this power
  double voltage;   // V, at which it hovers with that signal

  double full_signal(double battery) const {
    constexpr double min = 0.8, max = 1.3;
    return battery > 0 ? hover * std::clamp(voltage / battery, min, max) : hover;
  }
  double signal(double thrust, double battery) const {
    return full_signal(battery) * std::pow(std::max(thrust, 0.0), 1 / exponent);
  }
  double thrust(double signal, double battery) const { return std::pow(signal / full_signal(battery), exponent); }
};

}  // namespace jarol::tasks
