// Thrust of a rotor by its setting. Plain C++17.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace jarol::vehicles {

/// A power law. In a step each rotor's setting is asked for several times, by the integration's evaluations, the
/// accelerometer and the battery, so the newest powers are kept: one takes longer than all else of a rotor. A law
/// belongs to one vehicle, which one thread steps.
class ThrustLaw {
 public:
  ThrustLaw() = default;
  explicit ThrustLaw(double exponent) : exponent_(exponent) {}

  double exponent() const { return exponent_; }
  /// Of full thrust, at a setting from 0 to 1.
  double part(double setting) const {
    for (const Known& known : known_)
      if (known.setting == setting) return known.part;
    Known& oldest = known_[next_];
    next_ = (next_ + 1) % known_.size();
    oldest = {setting, std::pow(setting, exponent_)};
    return oldest.part;
  }

 private:
  struct Known {
    double setting = std::numeric_limits<double>::quiet_NaN();  // equals none
    double part = 0.0;
  };

  double exponent_ = 1.0;
  mutable std::array<Known, 3> known_{};
  mutable std::size_t next_ = 0;
};

}  // namespace jarol::vehicles
