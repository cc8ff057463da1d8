#include "tools/report/json_line.h"

#include <nlohmann/json.hpp>

namespace jarol::tools {

std::string json_line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace jarol::tools
