// Random graphs of the generic tasks, always valid, the same for the same seed everywhere.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "tests/runtime/oracle.h"

namespace jarol::oracle {

Model random_model(std::uint64_t seed);

/// The graph as YAML; `shuffle` changes the order of declaration.
std::string to_yaml(const Model& model, std::uint64_t shuffle);

/// A random graph of which every instant is a multiple of the step (ns); `keys` adds to what each task says.
std::string coarse_random_graph(std::uint64_t seed, std::int64_t step,
                                const std::function<std::string(const TaskModel&)>& keys);

/// One of steps so short that a machine can't always be in time; each ANY in it stands for a core.
std::string hurried_random_graph(std::uint64_t seed);

}  // namespace jarol::oracle
