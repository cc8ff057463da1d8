// What the submarine's fins and propeller do: where and how fast they are, and which of them no longer follow.
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

/// How fast the propeller turned last, and what it had been sent by then.
struct PropellerReading {
  double speed = 0;
  double commanded = 0;
  std::int64_t count = 0;

  static constexpr auto fields() {
    using P = PropellerReading;
    return describe(field<&P::speed>("rpm", "measured; below zero astern"),
                    field<&P::commanded>("", "sent before that, -1 to 1"), field<&P::count>("", "readings so far"));
  }
};

/// In the order of Actuation: bottom, port, starboard, top.
struct Servos {
  std::array<ServoReading, 4> fins{};
  PropellerReading propeller{};

  static constexpr auto fields() {
    return describe(field<&Servos::fins>("", "bottom, port, starboard, top"), field<&Servos::propeller>());
  }
};

enum class FinState : std::uint8_t { unknown, follows, stuck, silent };

constexpr auto enumerators(FinState) {
  using enum FinState;
  return std::array<Enumerator<FinState>, 4>{{{"unknown", unknown, "it has not reported yet, or never does"},
                                              {"follows", follows, "it goes where it is sent"},
                                              {"stuck", stuck, "it does not go where it is sent"},
                                              {"silent", silent, "it reports nothing, or no more"}}};
}

struct FinCondition {
  std::array<FinState, 4> states{};
  std::array<double, 4> angles{};
  FinState propeller = FinState::unknown;

  static constexpr auto fields() {
    using F = FinCondition;
    return describe(field<&F::states>("", "of bottom, port, starboard, top"),
                    field<&F::angles>("rad", "at which those that are stuck are held"),
                    field<&F::propeller>("", "unknown, follows or stuck: it does not turn as it is sent"));
  }
};

}  // namespace jarol::tasks
