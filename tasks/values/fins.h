// What the submarine's fins do: where their servos are, and which of them no longer follow.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::tasks {

/// Where a servo was last, and where it had been sent by then.
struct ServoReading {
  double angle = 0;
  double commanded = 0;
  std::int64_t count = 0;

  static constexpr auto fields() {
    using S = ServoReading;
    return describe(field<&S::angle>("rad", "measured"), field<&S::commanded>("rad", "sent before that"),
                    field<&S::count>("", "readings so far; -1: not fitted"));
  }
};

/// In the order of Actuation: bottom, port, starboard, top.
struct Servos {
  std::array<ServoReading, 4> fins{};

  static constexpr auto fields() { return describe(field<&Servos::fins>("", "bottom, port, starboard, top")); }
};

enum class FinState : std::uint8_t { unknown, follows, stuck, silent };

constexpr auto enumerators(FinState) {
  using enum FinState;
  return std::array<Enumerator<FinState>, 4>{{{"unknown", unknown, "its servo has not reported yet, or never does"},
                                              {"follows", follows, "it goes where it is sent"},
                                              {"stuck", stuck, "it does not go where it is sent"},
                                              {"silent", silent, "its servo reports no more"}}};
}

struct FinCondition {
  std::array<FinState, 4> states{};
  std::array<double, 4> angles{};

  static constexpr auto fields() {
    using F = FinCondition;
    return describe(field<&F::states>("", "of bottom, port, starboard, top"),
                    field<&F::angles>("rad", "at which those that are stuck are held"));
  }
};

}  // namespace jarol::tasks
