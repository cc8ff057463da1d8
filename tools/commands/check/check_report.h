// What `jarol check` reports of one graph, as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/measure.h"
#include "graph/analysis/check_graph.h"
#include "graph/analysis/remedies.h"

namespace jarol::tools {

/// Everything found about one graph, which outlives it.
struct CheckReport : analysis::GraphCheck {
  CheckReport(std::string of, analysis::GraphCheck found) : GraphCheck(std::move(found)), file(std::move(of)) {}

  std::string file;
  std::vector<analysis::Remedy> remedies;
  std::optional<Measurement> measured;
};

/// The task that exceeded its `wcet` by most when it was measured. Null: none did.
inline const Task* longer_than_stated(const CheckReport& report) {
  return report.measured ? longer_than_stated(*report.graph, *report.measured) : nullptr;
}

std::string to_text(const CheckReport& report);
nlohmann::ordered_json to_json(const CheckReport& report);

}  // namespace jarol::tools
