#include "tools/report/differences_report.h"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "graph/text/escape.h"

namespace jarol::tools {

std::string text_of(const Differences& differences, std::size_t max) {
  const std::optional<FirstDifference>& first = differences.first();
  if (!first) return "";
  std::string text = "  first       " + text_of(*first) + "\n";
  const std::vector<SignalDifference> signals = differences.signals();
  for (std::size_t i = 0; i < std::min(max, signals.size()); ++i)
    text += "  signal      " + signals[i].name + " " + text_of(signals[i]) + "\n";
  if (signals.size() > max)
    text += fmt::format("              and {} more signals; --json has all\n", signals.size() - max);
  return text;
}

nlohmann::ordered_json json_of(const Differences& differences) {
  nlohmann::ordered_json json{{"compared_values", differences.compared()}, {"first_difference", nullptr}};
  if (const std::optional<FirstDifference>& first = differences.first())
    json["first_difference"] = {{"instant_ns", first->instant.count()},
                                {"output", first->output},
                                {"field", first->field},
                                {"was", first->was},
                                {"is", first->is},
                                {"was_bits", first->was_bits},
                                {"is_bits", first->is_bits}};
  json["signals"] = nlohmann::ordered_json::array();
  for (const SignalDifference& signal : differences.signals()) {
    nlohmann::ordered_json one{{"name", signal.name}, {"values", signal.values}, {"first_ns", signal.first.count()}};
    if (signal.largest) one.update({{"largest", *signal.largest}, {"largest_at_ns", signal.largest_at.count()}});
    json["signals"].push_back(one);
  }
  return json;
}

}  // namespace jarol::tools
