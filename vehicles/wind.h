// Wind with gusts: a first-order Gauss-Markov process about the mean, from a seed.
#pragma once

#include <cstdint>

#include "vehicles/fossen.h"
#include "vehicles/helicopter_parameters.h"

namespace jarol::vehicles {

class Wind {
 public:
  explicit Wind(const AirParameters& parameters) : parameters_(parameters) {}

  void step(double seconds);

  /// NED, m/s.
  fossen::Vector3 now() const;

 private:
  double draw_normal();

  AirParameters parameters_;
  fossen::Vector3 gust_{};
  std::uint64_t drawn_ = 0;
};

}  // namespace jarol::vehicles
