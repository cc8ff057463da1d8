// Seeds: one number for a run, spread by name to whatever has noise.
#pragma once

#include "graph/values/digest.h"

namespace jarol {

/// A seed of its own for the part of that name.
inline std::uint64_t spread_seed(std::uint64_t seed, std::string_view name) {
  return digest::fold(seed ^ digest::key(0), digest::name_hash(name) ^ digest::key(1));
}

}  // namespace jarol
