// Runs with a common past, side by side.
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string_view>

#include "graph/text/escape.h"
#include "tools/commands/run/what_if.h"
#include "tools/report/differences_report.h"
#include "tools/report/verdicts.h"

namespace jarol::tools {
namespace {

// Angles in degrees.
double shown(const RunColumn::Reached& reached) {
  return reached.unit == "rad" ? reached.value * 180 / std::numbers::pi : reached.value;
}
const char* shown_unit(const RunColumn::Reached& reached) {
  return reached.unit == "rad" ? "deg" : reached.unit.c_str();
}

using RunColumns = std::vector<const RunColumn*>;

// One line of the table: what each column has of it.
template <class Text>
std::string line_of(const RunColumns& columns, const std::string& title, Text text_of_column) {
  std::string line = fmt::format("  {:<14}", title);
  for (const RunColumn* column : columns) line += fmt::format("  {:>18}", text_of_column(*column));
  return line + "\n";
}

std::string outcome_text(const Verdict& verdict) {
  switch (verdict.outcome) {
    case Verdict::Outcome::holds: return "holds";
    case Verdict::Outcome::fails: return "FAILS";
    case Verdict::Outcome::not_judged: return "not judged";
  }
  return "";
}

std::string table(const RunColumns& columns) {
  std::string text = fmt::format("  {:<14}", "");
  for (std::size_t i = 0; i < columns.size(); ++i)
    text += fmt::format("  {:>18}", i == 0 ? "the run" : "what if " + std::to_string(i));
  text += "\n";
  for (std::size_t i = 0; i < columns[0]->reached.size(); ++i) {
    const RunColumn::Reached& first = columns[0]->reached[i];
    text += line_of(columns, first.title + (first.is_true ? ", true" : ""), [&](const RunColumn& column) {
      return fmt::format("{:.3f} {}", shown(column.reached[i]), shown_unit(first));
    });
  }
  text += line_of(columns, "faults", [](const RunColumn& column) { return std::to_string(column.fault_count); });
  for (std::size_t i = 0; i < columns[0]->verdict.expectations.size(); ++i)
    text += line_of(columns, "expectation " + std::to_string(i + 1),
                    [&](const RunColumn& column) { return outcome_text(column.verdict.expectations[i]); });
  return text + line_of(columns, "digest", [](const RunColumn& c) { return fmt::format("0x{:016x}", c.digest); });
}

// As of a run, a line each.
std::string text_of_failures(const RunVerdict& verdict) {
  std::string text;
  std::istringstream lines(failures_text(verdict));
  constexpr std::string_view error = "error: ";
  for (std::string line; std::getline(lines, line);)
    text += "  failed      " + (line.starts_with(error) ? line.substr(error.size()) : line) + "\n";
  return text;
}

}  // namespace

std::string to_text(const RunColumn& run, const std::vector<WhatIfOutcome>& what_ifs) {
  if (what_ifs.empty()) return "";
  std::string text;
  RunColumns columns{&run};
  for (const WhatIfOutcome& each : what_ifs) {
    text += "  what if " + std::to_string(columns.size()) + "   " + to_text(each.what_if) + "\n";
    columns.push_back(&each.column);
  }
  text += table(columns);
  for (std::size_t i = 0; i < what_ifs.size(); ++i) {
    const auto& [what_if, column, differences] = what_ifs[i];
    constexpr std::size_t max_signals = 8;
    text += "  what if " + std::to_string(i + 1) + "   " +
            (differences.first() ? "parts from the run\n"
                                 : "is the run, " + std::to_string(differences.compared()) + " values are the same\n");
    text += text_of(differences, max_signals);
    if (!column.stopped.empty()) text += "  stopped     " + printable(column.stopped) + "\n";
    text += text_of_failures(column.verdict);
  }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<WhatIfOutcome>& what_ifs) {
  auto all = nlohmann::ordered_json::array();
  for (const auto& [what_if, column, differences] : what_ifs) {
    auto reached = nlohmann::ordered_json::object(), truth = nlohmann::ordered_json::object();
    for (const RunColumn::Reached& each : column.reached)
      (each.is_true ? truth : reached)[each.title] = {{"value", shown(each)}, {"unit", shown_unit(each)}};
    nlohmann::ordered_json json{{"at_ns", what_if.at.count()},
                                {"set", what_if.set},
                                {"digest", fmt::format("0x{:016x}", column.digest)},
                                {"fault_count", column.fault_count},
                                {"stopped", nullptr},
                                {"reached", reached},
                                {"truly_reached", truth},
                                {"judgement", to_json(column.verdict)}};
    if (!column.stopped.empty()) json["stopped"] = column.stopped;
    json.update(json_of(differences));
    all.push_back(std::move(json));
  }
  return all;
}

}  // namespace jarol::tools
