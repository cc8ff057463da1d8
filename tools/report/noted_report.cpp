#include "tools/report/noted_report.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "graph/language/quantities.h"
#include "graph/text/escape.h"

namespace jarol::tools {

std::string to_text(const StatusEvents::Kept& kept) {
  std::string text;
  for (const StatusEvents::Event& event : kept.events) {
    std::string words, meanings;
    for (const StatusEvents::Stood& value : event.values) {
      if (!value.changed) continue;
      words += (words.empty() ? "" : ", ") + value.path + (value.path.empty() ? "" : " ") + value.name;
      if (!value.meaning.empty()) meanings += (meanings.empty() ? ": " : ", ") + value.meaning;
    }
    text +=
        "  event       " + event.communicator + " at " + seconds_text(event.instant) + " s: " + words + meanings + "\n";
  }
  for (const auto& [communicator, count] : kept.more)
    text += "  event       " + communicator + ": and " + std::to_string(count) + " changes more\n";
  return text;
}

nlohmann::ordered_json to_json(const StatusEvents::Kept& kept) {
  auto json = nlohmann::ordered_json::array();
  for (const StatusEvents::Event& event : kept.events) {
    auto values = nlohmann::ordered_json::object(), meanings = nlohmann::ordered_json::array();
    for (const StatusEvents::Stood& value : event.values) {
      values[value.path.empty() ? "value" : value.path] = value.name;
      if (!value.meaning.empty()) meanings.push_back(value.meaning);
    }
    json.push_back({{"communicator", event.communicator},
                    {"instant_ns", event.instant.count()},
                    {"values", std::move(values)},
                    {"meanings", std::move(meanings)}});
  }
  return json;
}

std::string to_text(const LoggedTexts::Kept& kept) {
  std::string text;
  for (const LoggedTexts::Text& logged : kept.texts)
    text += "  logged      " + logged.output + " at " + seconds_text(logged.instant) + " s: " + printable(logged.text) +
            "\n";
  for (const auto& [output, count] : kept.more)
    text += "  logged      " + output + ": and " + std::to_string(count) + " texts more\n";
  return text;
}

nlohmann::ordered_json to_json(const LoggedTexts::Kept& kept) {
  auto json = nlohmann::ordered_json::array();
  for (const LoggedTexts::Text& logged : kept.texts)
    json.push_back({{"output", logged.output}, {"instant_ns", logged.instant.count()}, {"text", logged.text}});
  return json;
}

}  // namespace jarol::tools
