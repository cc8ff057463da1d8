// A battery whose voltage sags with the current drawn and with the charge used.
#pragma once

#include <array>

#include "graph/values/archive.h"
#include "vehicles/helicopter/parameters.h"

namespace jarol::vehicles {

class Battery {
 public:
  explicit Battery(const BatteryParameters& parameters) : parameters_(parameters) {}

  /// Current for rotors that give these parts of their full thrust; each counts a quarter.
  double calc_current(const std::array<double, 4>& thrusts) const;

  /// A current flows for some seconds.
  void draw(double current, double seconds) { used_ += current * seconds; }

  /// At the terminals, under a current; 0 when all charge is used.
  double calc_voltage(double current) const;

  void serialize(Archive& archive) { archive(used_); }

 private:
  BatteryParameters parameters_;
  double used_ = 0.0;  // A s
};

}  // namespace jarol::vehicles
