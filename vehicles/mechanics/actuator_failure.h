// Actuators (motors, fins, propellers) that fail at a time or by chance, as a vehicle file says.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"
#include "vehicles/sensors/noise.h"

namespace jarol::vehicles {

enum class ActuatorFailureKind : std::uint8_t { none, lost, stuck, weak, hardover };

constexpr auto enumerators(ActuatorFailureKind) {
  using enum ActuatorFailureKind;
  return std::array<Enumerator<ActuatorFailureKind>, 5>{
      {{"none", none},
       {"lost", lost, "a motor or propeller turns no more, a fin is broken off"},
       {"stuck", stuck, "a motor or propeller turns on as it did, a fin stays where it is"},
       {"weak", weak, "it gives a part of its force"},
       {"hardover", hardover, "it goes to an end of its travel and stays: a motor at full speed, a fin at its limit"}}};
}

struct ActuatorFailure {
  ActuatorFailureKind kind = ActuatorFailureKind::none;
  double at = 0.0;
  double by = 0.5;
  double to = 1.0;
  double chance = 0.0;
  double lasts = 0.0;

  static constexpr auto fields() {
    using A = ActuatorFailure;
    return describe(field<&A::kind>("", "how it fails"), field<&A::at>("s", "when it begins, or may begin"),
                    field<&A::by>("", "part of its force that a weak one gives").in(0, 1),
                    field<&A::to>("", "part of its full travel to which a hardover one goes").in(-1, 1),
                    field<&A::chance>("1/s", "rate at which it begins from then on; 0: it begins then"),
                    field<&A::lasts>("s", "after its begin it is sound again; 0: never").in(0, 1e9));
  }
};

/// An actuator's failure in one run.
class FailingActuator {
 public:
  FailingActuator() = default;
  FailingActuator(const ActuatorFailure& failure, std::uint64_t seed)
      : failure_(failure), begin_(draw_begin(failure.at, failure.chance, seed)) {}

  bool is_stuck(double seconds) const { return kind(seconds) == ActuatorFailureKind::stuck; }

  /// What it is commanded, or what it does instead, where `full` is its full travel.
  double command(double seconds, double commanded, double full) const {
    return kind(seconds) == ActuatorFailureKind::hardover ? failure_.to * full : commanded;
  }

  /// The part of its force that it gives.
  double part(double seconds) const {
    switch (kind(seconds)) {
      case ActuatorFailureKind::lost: return 0.0;
      case ActuatorFailureKind::weak: return failure_.by;
      case ActuatorFailureKind::none:
      case ActuatorFailureKind::stuck:
      case ActuatorFailureKind::hardover: break;
    }
    return 1.0;
  }

 private:
  ActuatorFailureKind kind(double seconds) const {
    return lasts_at(seconds, begin_, failure_.lasts) ? failure_.kind : ActuatorFailureKind::none;
  }

  ActuatorFailure failure_{};
  double begin_ = 0.0;
};

}  // namespace jarol::vehicles
