// What a vehicle reports that was steered over a link: when nobody steered it, where it ended, what was carried.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "distributers/serve/serve_vehicle.h"

namespace jarol::tools {

std::string to_text(const vehicles::VehicleClass& vehicle_class, const ServeOutcome& outcome);
nlohmann::ordered_json to_json(const vehicles::VehicleClass& vehicle_class, const ServeOutcome& outcome);

}  // namespace jarol::tools
