// JSON Schema of values: what their types let one write.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "graph/values/type.h"

namespace jarol::tools {

/// Regular expressions of what is written with a unit.
extern const std::string duration_pattern, positive_duration_pattern, bytes_pattern;

/// Of a number in that unit, as a regular expression.
std::string number_pattern(const std::string& unit);

/// A value of the type, a number in that unit.
nlohmann::ordered_json value_schema(const Type& type, const std::string& unit, const FieldRange& range = {});

/// A mapping of some of the struct's fields, with their meanings and defaults.
nlohmann::ordered_json fields_schema(const Type& type);

}  // namespace jarol::tools
