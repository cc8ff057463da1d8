// What integrates a vehicle's motion.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::vehicles {

/// Both under the same forces, with the same sensors and messages.
enum class Dynamics : std::uint8_t { simbody, rigid };

constexpr auto enumerators(Dynamics) {
  using enum Dynamics;
  return std::array<Enumerator<Dynamics>, 2>{
      {{"simbody", simbody, "a multibody system of Simbody"}, {"rigid", rigid, "one rigid body, many times as fast"}}};
}

}  // namespace jarol::vehicles
