// Sensors that fail on schedule, as a vehicle file says.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::vehicles {

/// A lost sensor tells nothing any more; a stuck one tells its last reading for ever; a biased one is wrong by an
/// amount.
enum class FailureKind : std::uint8_t { none, lost, stuck, biased };

constexpr auto enumerators(FailureKind) {
  return std::array<Enumerator<FailureKind>, 4>{{{"none", FailureKind::none},
                                                 {"lost", FailureKind::lost},
                                                 {"stuck", FailureKind::stuck},
                                                 {"biased", FailureKind::biased}}};
}

struct SensorFailure {
  FailureKind kind = FailureKind::none;
  double at = 0.0;
  double by = 0.0;

  static constexpr auto fields() {
    using S = SensorFailure;
    return describe(field<&S::kind>("", "none, lost, stuck or biased"), field<&S::at>("s", "when it begins"),
                    field<&S::by>("", "what a biased one adds, in the unit of what it measures"));
  }

  FailureKind now(double seconds) const { return seconds >= at ? kind : FailureKind::none; }
};

}  // namespace jarol::vehicles
