// What pages send, read.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace jarol::tools::console {

/// What is no JSON is discarded. Throws InputError for what is nested too deep: values are copied, written
/// and destroyed level by level, each on the stack.
nlohmann::json parse_json(const std::string& message);

/// An object {"do": ...}; else throws InputError, with the example of one, as in {"do": "pause"}.
nlohmann::json parse_request(const std::string& message, const char* example);

}  // namespace jarol::tools::console
