// The motion of a vehicle as CSV.
#pragma once

#include <string>
#include <vector>

#include "distributers/interfaces/vehicle.h"
#include "graph/values/bind.h"
#include "runtime/files/atomic_file.h"

namespace jarol::tools {

class MotionFile {
 public:
  /// The file appears when it is committed. Throws std::runtime_error if it can't be written; so do the others.
  MotionFile(const std::string& path, const vehicles::VehicleClass& vehicle_class);

  /// A row: `time` (s), the state, then the vehicle's other outputs; an empty cell for what no sensor has reported yet.
  void add(std::chrono::nanoseconds at, const vehicles::Vehicle& vehicle);
  void commit() { file_.commit(); }

 private:
  std::vector<Leaf> states_, outputs_;
  AtomicFile file_;
  std::string row_;
};

}  // namespace jarol::tools
