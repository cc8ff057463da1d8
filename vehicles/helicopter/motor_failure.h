// Motors that fail at a time or by chance, as a vehicle file says.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "graph/values/describe.h"
#include "vehicles/sensors/noise.h"

namespace jarol::vehicles {

enum class MotorFailureKind : std::uint8_t { none, lost, stuck, weak };

constexpr auto enumerators(MotorFailureKind) {
  return std::array<Enumerator<MotorFailureKind>, 4>{{{"none", MotorFailureKind::none},
                                                      {"lost", MotorFailureKind::lost, "turns no more"},
                                                      {"stuck", MotorFailureKind::stuck, "turns on as it did"},
                                                      {"weak", MotorFailureKind::weak, "gives a part of its thrust"}}};
}

struct MotorFailure {
  MotorFailureKind kind = MotorFailureKind::none;
  double at = 0.0;
  double by = 0.5;
  double chance = 0.0;

  static constexpr auto fields() {
    using M = MotorFailure;
    return describe(field<&M::kind>("", "how it fails"), field<&M::at>("s", "when it begins, or may begin"),
                    field<&M::by>("", "part of its thrust that a weak one gives"),
                    field<&M::chance>("1/s", "rate at which it begins from then on; 0: it begins then"));
  }
};

/// A motor's failure in one run.
class FailingMotor {
 public:
  FailingMotor() = default;
  FailingMotor(const MotorFailure& failure, std::uint64_t seed)
      : failure_(failure), begin_(draw_begin(failure.at, failure.chance, seed)) {}

  /// The setting that it goes to when that one is wanted; thrust grows with it to a power.
  double follow(double setting, double thrust_exponent, double seconds) {
    if (seconds < begin_ || failure_.kind == MotorFailureKind::none) return held_ = setting;
    switch (failure_.kind) {
      case MotorFailureKind::lost: return 0.0;
      case MotorFailureKind::weak: return setting * std::pow(failure_.by, 1.0 / thrust_exponent);
      case MotorFailureKind::stuck:
      case MotorFailureKind::none: break;
    }
    return held_;
  }

  void serialize(Archive& archive) { archive(held_); }

 private:
  MotorFailure failure_{};
  double begin_ = 0.0;
  double held_ = 0.0;  // of the last step before
};

}  // namespace jarol::vehicles
