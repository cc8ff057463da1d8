// Wind with gusts: a first-order Gauss-Markov process about the mean.
#pragma once

#include "vehicles/air/parameters.h"
#include "vehicles/mechanics/fossen.h"
#include "vehicles/sensors/noise.h"

namespace jarol::vehicles {

class Wind {
 public:
  Wind(const AirParameters& parameters, std::uint64_t seed) : parameters_(parameters), noise_(seed) {}

  void step(double seconds);

  /// NED, m/s.
  fossen::Vector3 now() const;

 private:
  AirParameters parameters_;
  Noise noise_;
  fossen::Vector3 gust_{};
};

}  // namespace jarol::vehicles
