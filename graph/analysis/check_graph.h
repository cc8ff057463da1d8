// All that is found out about one graph: the verdict, its margins, and chains.
#pragma once

#include <optional>
#include <vector>

#include "graph/analysis/chains.h"
#include "graph/analysis/check.h"
#include "graph/analysis/sensitivity.h"

namespace jarol::analysis {

struct CheckedChain {
  Chain chain;
  ChainLatency latency;
};

struct GraphCheck {
  const Graph* graph = nullptr;
  Result result;
  std::optional<Sensitivity> sensitivity;
  std::vector<CheckedChain> chains;  // of the graph, then every path, where these are asked for
  bool more_paths = false;           // than those
  bool all_walked = true;            // else there may be more than those
};

/// Margins come where they are found quickly, with `sensitivity` in any case; with `all_chains` also every path from an
/// `in` to an `out`. The graph outlives what is found.
GraphCheck check_graph(const Graph& graph, bool sensitivity = false, bool all_chains = false);

/// Does the chain keep its limits? None: its latency is known by bounds only, and these exceed one.
std::optional<bool> holds(const CheckedChain& chain);
/// Does every chain? None: not known of some, and broken by none.
std::optional<bool> chains_hold(const GraphCheck& check);

}  // namespace jarol::analysis
