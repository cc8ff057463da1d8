// Random graphs of the generic tasks, always valid, the same for the same seed everywhere.
#pragma once

#include <cstdint>
#include <string>

#include "tests/runtime/oracle.h"

namespace jarol::oracle {

Model random_model(std::uint64_t seed);

/// The graph as YAML; `shuffle` changes the order of declaration.
std::string to_yaml(const Model& model, std::uint64_t shuffle);

}  // namespace jarol::oracle
