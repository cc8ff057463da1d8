// What `jarol check` reports of one graph, as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "graph/analysis/chains.h"
#include "graph/analysis/check.h"
#include "graph/analysis/sensitivity.h"
#include "tools/commands/check/measure.h"
#include "tools/commands/check/remedies.h"

namespace jarol::tools {

struct ReportedChain {
  Chain chain;
  analysis::ChainLatency latency;
};

/// Everything found about one graph.
struct CheckReport {
  std::string file;
  const Graph* graph = nullptr;
  analysis::Result result;
  std::optional<analysis::Sensitivity> sensitivity;
  std::vector<Remedy> remedies;
  std::vector<ReportedChain> chains;
  bool more_paths = false;  // than those of --chains
  bool all_walked = true;   // else there may be more than those of --chains
  std::optional<Measurement> measured;
};

/// The task that exceeded its `wcet` by most when it was measured: the verdict is of other times than those of this
/// machine. Null: none did.
const Task* longer_than_stated(const CheckReport& report);

/// Does every chain keep its limits? None: not known of some, and broken by none.
std::optional<bool> chains_hold(const CheckReport& report);

std::string to_text(const CheckReport& report);
nlohmann::ordered_json to_json(const CheckReport& report);

}  // namespace jarol::tools
