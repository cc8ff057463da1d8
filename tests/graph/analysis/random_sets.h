// Small random task sets with any mix of features, as graphs and as text.
#pragma once

#include <functional>

#include "tests/graph/analysis/truth.h"

namespace jarol::truth {

/// Which features a set may have.
struct Features {
  bool jitter = true, blocking = true, data_flow = true, any_phasing = true;
  int cores = 2;
};

Set random_set(std::uint64_t seed, const Policy& policy, const Features& features);

/// A table of up to twelve tasks on given cores, each core full or almost, chains going from core to core: where
/// waiting for others may let backlog grow, period by period.
Set random_chains(std::uint64_t seed);

/// A valid graph, as the loader makes it of `yaml_of`, in a hundredth of the time.
Graph graph_of(const Set& set);

/// `unit` is the unit of time, as in "ms"; `type` says what a task with so many inputs is.
using TypeOf = std::function<std::string(const Task& task, std::size_t inputs)>;
std::string counting_type(const Task& task, std::size_t inputs);
std::string yaml_of(const Set& set, const std::string& unit, const TypeOf& type = counting_type);

Places places_in(const Graph& graph);

}  // namespace jarol::truth
