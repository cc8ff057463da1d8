// Parameters, inputs and outputs as `jarol tasks` shows them, with the members of structs at every depth.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "graph/values/type.h"

namespace jarol::tools {

/// One a line below the title, with defaults if these are asked for.
void print_fields(const std::string& title, const Type& type, bool with_defaults);

/// One object each; those that are structs have "members", each by its path.
nlohmann::ordered_json fields_json(const Type& type);

}  // namespace jarol::tools
