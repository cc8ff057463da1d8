#include "tools/console/page_message.h"

#include "graph/text/errors.h"

namespace jarol::tools::console {

nlohmann::json parse_json(const std::string& message) {
  constexpr int deepest = 64;
  const auto check_depth = [](int depth, nlohmann::json::parse_event_t, const nlohmann::json&) {
    if (depth > deepest) throw InputError("the message is nested deeper than " + std::to_string(deepest) + " levels");
    return true;
  };
  return nlohmann::json::parse(message, check_depth, false);
}

nlohmann::json parse_request(const std::string& message, const char* example) {
  auto json = parse_json(message);
  if (!json.is_object() || !json.contains("do") || !json["do"].is_string())
    throw InputError(std::string("expected an object as in ") + example);
  return json;
}

}  // namespace jarol::tools::console
