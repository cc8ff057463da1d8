// Wind with shear and gusts: first-order Gauss-Markov processes about the mean, or those of Dryden.
#pragma once

#include "vehicles/air/parameters.h"
#include "vehicles/mechanics/fossen.h"
#include "vehicles/sensors/noise.h"

namespace jarol::vehicles {

class Wind {
 public:
  Wind(const AirParameters& parameters, std::uint64_t seed);

  void step(double seconds);

  /// NED, m/s, so high above the ground.
  fossen::Vector3 now(double height) const;

  void serialize(Archive& archive) { archive(noise_, gust_, first_, lagged_, time_); }

 private:
  AirParameters parameters_;
  Noise noise_;
  fossen::Vector3 gust_{};                       // along the mean wind, across it, down
  fossen::Vector3 first_{}, lagged_{};           // that those of second order are made of
  double along_north_ = 1.0, along_east_ = 0.0;  // the mean wind's direction
  double time_ = 0.0, gust_begin_ = 0.0;         // s
};

}  // namespace jarol::vehicles
