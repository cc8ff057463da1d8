// A vehicle alone, driven by a script of commands, and its motion as CSV.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "distributers/interfaces/vehicle.h"
#include "graph/language/problems.h"
#include "graph/values/type_of.h"
#include "graph/values/value.h"

namespace jarol::tools {

/// Commands from a time on until those of the next row.
struct Commands {
  Duration time{};
  Value inputs;
};

/// Columns: `time` (s), then inputs of the vehicle. A column that is missing leaves its input at rest, an empty cell
/// keeps what was. What is wrong goes to `problems`.
std::vector<Commands> read_commands(const std::shared_ptr<const Source>& script, const vehicles::VehicleClass& vehicle,
                                    Problems& problems);

/// Writes a row each `period`, a multiple of the vehicle's grid, from 0 to `end`, both included: `time`, the state,
/// then the vehicle's other outputs; an empty cell for what no sensor has reported yet. The file appears when it is
/// whole. Throws std::runtime_error if the vehicle has no state any more or the file can't be written.
void run_open_loop(vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class,
                   const std::vector<Commands>& commands, Duration period, Duration end, const std::string& path);

}  // namespace jarol::tools
