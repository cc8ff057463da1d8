// JSON as the command prints it: one line, whatever bytes its texts hold.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace jarol::tools {

/// With its line end; in ASCII, so that no terminal obeys a character of it. What is no UTF-8 becomes U+FFFD.
std::string json_line(const nlohmann::ordered_json& json);

}  // namespace jarol::tools
