// Latency along a path of tasks and communicators, in logical time: what `run` does, exactly.
#pragma once

#include "graph/analysis/task_model.h"
#include "graph/model/graph.h"

namespace jarol::analysis {

struct ChainLatency {
  bool exact = true;           // else upper bounds, as the path repeats too late to be enumerated, or phasing is open
  Duration max_reaction{};     // from a stimulus just missed by the first read to the first output that shows it
  Duration min_reaction{};     // from a read to the first output that shows it
  Duration max_reduced{};      // as max_reaction, counted from the read
  Duration max_age{};          // from a read to the last instant at which an output of it is still valid
  Duration max_reduced_age{};  // as max_age, up to the instant of the output
  Duration jitter{};           // max_reduced - min_reaction
  Duration bound{};            // sum of periods and LETs (Davare et al. 2007)
  std::vector<Duration> at;    // the instants of the hops on the slowest way; the first is its read
};

/// Of the latencies of one graph, what they take together at most.
inline constexpr std::uint64_t max_steps_of_chains = 100'000'000;

/// A path of a valid graph, not empty. Each hop of each activation is a step; upper bounds where that is more than is
/// left.
ChainLatency latency_of(const Graph& graph, const std::vector<End>& path, Budget& budget);

/// The limits of a chain that its latency exceeds, as "reaction 12ms over 11ms"; of a reaction first.
std::vector<std::string> broken_limits(const Chain& chain, const ChainLatency& latency);

}  // namespace jarol::analysis
