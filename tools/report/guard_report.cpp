#include "tools/report/guard_report.h"

#include <nlohmann/json.hpp>

namespace jarol::tools {

std::string to_text(const Guard& guard) {
  if (guard.safe().empty()) return "";
  std::string names;
  for (const std::string& name : guard.safe()) names += (names.empty() ? "" : ", ") + name;
  return "  guardian    " + (guard.missing().empty() ? "was ready with safe of " + names : "none: " + guard.missing()) +
         "\n";
}

nlohmann::ordered_json to_json(const Guard& guard) {
  if (guard.safe().empty()) return nullptr;
  nlohmann::ordered_json json{{"ready", guard.missing().empty()}, {"safe", guard.safe()}};
  if (!guard.missing().empty()) json["missing"] = guard.missing();
  return json;
}

}  // namespace jarol::tools
