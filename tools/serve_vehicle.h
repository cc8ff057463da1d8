// A simulated vehicle as a process of its own, in real time: messages over a link steer it, its sensors answer.
#pragma once

#include "distributers/links/link.h"
#include "vehicles/vehicle.h"

namespace jarol::tools {

/// Runs until `end` or Ctrl-C and tells what was carried; the exit code.
int serve_vehicle(vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class, distributers::Link& link,
                  std::chrono::nanoseconds end);

}  // namespace jarol::tools
