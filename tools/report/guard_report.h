// The guardian of a run, in its report.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "distributers/session/guard.h"

namespace jarol::tools {

/// A line, or nothing where there is nothing that it could hand over; the same as an object, or null.
std::string to_text(const Guard& guard);
nlohmann::ordered_json to_json(const Guard& guard);

}  // namespace jarol::tools
