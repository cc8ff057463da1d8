// A simulated vehicle as a process of its own, on the logical clocks of those who run graphs with it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "distributers/interfaces/vehicle.h"
#include "distributers/links/address.h"
#include "distributers/links/secret_key.h"

namespace jarol::tools {

/// A line on stderr of what has become of a vehicle that no mission wants.
void report(const vehicles::Mishap& mishap, const std::string& name);

/// Those who connect have it one after the other, each a vehicle of its own from the start; until Ctrl-C. The exit
/// code. Throws InputError if it can't listen there.
int serve_vehicle_in_lockstep(const vehicles::VehicleClass& vehicle_class, const distributers::Address& listen,
                              const std::function<std::unique_ptr<vehicles::Vehicle>(std::uint64_t seed)>& make,
                              const std::optional<distributers::SecretKey>& key);

}  // namespace jarol::tools
