// Thrust of the rotors by their settings. Plain C++17.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "graph/math/powers.h"

namespace jarol::vehicles {

/// A power law. In a step the rotors' settings are asked for several times, by the integration's evaluations, the
/// accelerometer and the battery, so the newest powers are kept: they take longer than all else of the rotors. A law
/// belongs to one vehicle, which one thread steps.
class ThrustLaw {
 public:
  using Rotors = std::array<double, 4>;

  ThrustLaw() = default;
  explicit ThrustLaw(double exponent) : exponent_(exponent) {}

  double exponent() const { return exponent_; }
  /// Of full thrust each, at settings from 0 to 1.
  const Rotors& parts(const Rotors& settings) const {
    for (const Known& known : known_)
      if (known.settings == settings) return known.parts;
    Known& oldest = known_[next_];
    next_ = (next_ + 1) % known_.size();
    oldest = {settings, math::pow_each(settings, exponent_)};
    return oldest.parts;
  }

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();  // equals none
  struct Known {
    Rotors settings{none, none, none, none};
    Rotors parts{};
  };

  double exponent_ = 1.0;
  mutable std::array<Known, 3> known_{};
  mutable std::size_t next_ = 0;
};

}  // namespace jarol::vehicles
