// The surface of the sea and the water under it: regular waves of small steepness in deep water, after Airy; Fossen,
// "Handbook of Marine Craft Hydrodynamics and Motion Control", 2011, ch. 8. In a frame that the current carries along.
// Plain C++17.
#pragma once

#include "vehicles/mechanics/fossen.h"

namespace jarol::vehicles {

/// The water at one place, NED.
struct Water {
  double surface = 0.0;              // z of the surface above or below the place
  double head = 0.0;                 // of the pressure there over that of still water, m of water
  fossen::Vector3 velocity_n{};      // orbital
  fossen::Vector3 acceleration_n{};  // of the water there as it moves: material derivative
};

class Waves {
 public:
  Waves() = default;
  /// Crest to trough, time from crest to crest, and where they run, clockwise from north. A height of 0 is still water.
  /// Throws InputError for waves that would break: steeper than 1 in 7 (Miche, 1944).
  Waves(double height, double period, double direction);

  bool still() const { return amplitude_ == 0.0; }
  Water at(const fossen::Vector3& p_n, double seconds) const;

 private:
  double amplitude_ = 0.0;
  double frequency_ = 1.0;  // rad/s
  double number_ = 1.0;     // rad/m
  double north_ = 1.0, east_ = 0.0;
};

}  // namespace jarol::vehicles
