// Who sees how a simulated vehicle moves.
#pragma once

#include "distributers/interfaces/vehicle.h"

namespace jarol {

/// The vehicle at an instant of its grid, after its step.
struct VehicleMoment {
  std::chrono::nanoseconds instant{};
  bool heard = false;  // have messages come since the instant before?
  const vehicles::Vehicle& vehicle;
};

class VehicleSink {
 public:
  virtual ~VehicleSink() = default;
  /// At each instant from 0 on, in order.
  virtual void add(const VehicleMoment& moment) = 0;
};

}  // namespace jarol
