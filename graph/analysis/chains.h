// Latency along a path of tasks and communicators, in logical time: what `run` does, exactly.
#pragma once

#include "graph/analysis/task_model.h"
#include "graph/model/graph.h"

namespace jarol::analysis {

struct ChainLatency {
  bool exact = true;  // else upper bounds, as the path repeats too late to be enumerated, or phasing is open
  std::int64_t max_reaction = 0;  // ns: from a stimulus just missed by the first read to the first output that shows it
  std::int64_t min_reaction = 0;  // ns: from a read to the first output that shows it
  std::int64_t max_reduced = 0;   // ns: as max_reaction, counted from the read
  std::int64_t max_age = 0;       // ns: from a read to the last instant at which an output of it is still valid
  std::int64_t max_reduced_age = 0;  // ns: as max_age, up to the instant of the output
  std::int64_t jitter = 0;           // ns: max_reduced - min_reaction
  std::int64_t bound = 0;            // ns: sum of periods and LETs (Davare et al. 2007)
  std::vector<std::int64_t> at;      // ns: the instants of the hops on the slowest way; the first is its read
};

/// Of the latencies of one graph, what they take together at most.
inline constexpr std::uint64_t max_steps_of_chains = 100'000'000;

/// A path of a valid graph, not empty. Each hop of each activation is a step; upper bounds where that is more than is
/// left.
ChainLatency latency_of(const Graph& graph, const std::vector<End>& path, Budget& budget);

/// The limits of a chain that its latency exceeds, as "reaction 12ms over 11ms"; of a reaction first.
std::vector<std::string> broken_limits(const Chain& chain, const ChainLatency& latency);

}  // namespace jarol::analysis
