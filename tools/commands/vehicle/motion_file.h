// The motion of a vehicle as CSV.
#pragma once

#include <string>
#include <vector>

#include "distributers/serve/vehicle_sink.h"
#include "graph/values/bind.h"
#include "runtime/files/atomic_file.h"

namespace jarol::tools {

class MotionFile : public VehicleSink {
 public:
  /// A row each `period`, a multiple of the vehicle's grid: `time` (s), the state, then the vehicle's other outputs; an
  /// empty cell for what no sensor has reported yet. The file appears when it is committed. Throws std::runtime_error
  /// if it can't be written; so do the others.
  MotionFile(const std::string& path, const vehicles::VehicleClass& vehicle_class, std::chrono::nanoseconds period);

  void add(const VehicleMoment& moment) override;
  void commit() { file_.commit(); }

 private:
  const std::chrono::nanoseconds period_;
  std::vector<Leaf> states_, outputs_;
  AtomicFile file_;
  std::string row_;
};

}  // namespace jarol::tools
