// A value as JSON, led by its description: structs as objects, arrays as lists, numbers exactly.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "graph/values/type.h"

namespace jarol::tools {

nlohmann::ordered_json to_json(const Type& type, const void* value);

}  // namespace jarol::tools
