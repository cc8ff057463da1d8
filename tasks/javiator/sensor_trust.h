// Which of the helicopter's sensors can be believed.
#pragma once

#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::tasks {

/// Whether a sensor can be believed. One that is lost in flight stays so until the vehicle stands again.
struct SensorTrust {
  double silent = 0;
  double last = 0;
  std::uint32_t repeats = 0;
  bool lost = false;

  static constexpr auto fields() {
    using S = SensorTrust;
    return describe(field<&S::silent>("s", "since it reported something credible"), field<&S::last>("", "reading"),
                    field<&S::repeats>("", "of that reading"), field<&S::lost>());
  }
};

/// Counts repeats, and silence in the answers that come; says whether there is a new reading.
bool hear(SensorTrust& trust, bool is_new, double reading, std::uint32_t max_repeats, double dt);

/// Takes a credible reading as a sign of life; returns whether to use it.
bool believe(SensorTrust& trust, bool credible, double patience);

/// On the ground it may come back.
void forgive(SensorTrust& trust, bool heard);

}  // namespace jarol::tasks
