#include "tools/report/guard_report.h"

#include <nlohmann/json.hpp>

#include "graph/language/problems.h"

namespace jarol::tools {

std::string to_text(const Guard& guard) {
  std::vector<std::string> words;
  if (!guard.safe().empty())
    words.push_back(guard.missing().empty() ? "was ready with safe of " + list_of(guard.safe())
                                            : "none: " + guard.missing());
  if (!guard.unreached().empty()) words.push_back("no way over " + list_of(guard.unreached()));
  return words.empty() ? "" : "  guardian    " + list_of(words) + "\n";
}

nlohmann::ordered_json to_json(const Guard& guard) {
  if (guard.safe().empty() && guard.unreached().empty()) return nullptr;
  nlohmann::ordered_json json{{"ready", guard.missing().empty() && !guard.safe().empty()}, {"safe", guard.safe()}};
  if (!guard.unreached().empty()) json["unreached"] = guard.unreached();
  if (!guard.missing().empty()) json["missing"] = guard.missing();
  return json;
}

}  // namespace jarol::tools
