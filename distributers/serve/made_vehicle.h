// A simulated vehicle alone, as whoever wants it describes it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "distributers/interfaces/vehicle.h"
#include "graph/language/problems.h"
#include "graph/named_list.h"
#include "graph/values/value.h"

namespace jarol {

/// How messages name the options of a vehicle, by default in a C++ program.
struct VehicleWords {
  std::string set = ".set";
  std::string initial = ".initial";
};

struct VehicleOptions {
  std::string parameters{};        // a file; empty: as the class has them
  std::vector<std::string> set{};  // "sea.density=1025"
  std::string initial{};           // "z=4,theta=5deg" over the state where it stands
  std::uint64_t seed = 0;          // of the sensors' noise
  VehicleWords words{};
};

/// A value of the class' type of parameters; its file is one of the vehicles that are known. What is wrong goes to
/// `problems`.
Value read_parameters(const VehicleOptions& options, const vehicles::VehicleClass& vehicle,
                      const NamedList<vehicles::VehicleClass>& known, Problems& problems);

/// In its initial state. Throws SpecError with all problems if there are any; InputError if there can be no
/// such vehicle.
std::unique_ptr<vehicles::Vehicle> make_vehicle(const VehicleOptions& options,
                                                const vehicles::VehicleClass& vehicle_class, const Value& parameters,
                                                std::uint64_t seed, Problems& problems);

/// The share of the vehicle in the seed of the options.
std::uint64_t own_seed(const VehicleOptions& options, const vehicles::VehicleClass& vehicle_class);

}  // namespace jarol
