// Sensors that fail at a time or by chance, as a vehicle file says.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"
#include "vehicles/sensors/noise.h"

namespace jarol::vehicles {

enum class FailureKind : std::uint8_t { none, lost, stuck, biased, drifting, jumping, noisy };

constexpr auto enumerators(FailureKind) {
  return std::array<Enumerator<FailureKind>, 7>{
      {{"none", FailureKind::none},
       {"lost", FailureKind::lost, "reports nothing"},
       {"stuck", FailureKind::stuck, "reports its last reading"},
       {"biased", FailureKind::biased, "is wrong by an amount"},
       {"drifting", FailureKind::drifting, "is wrong by an amount more each second"},
       {"jumping", FailureKind::jumping, "is wrong by an amount, to either side, in every second reading by chance"},
       {"noisy", FailureKind::noisy, "has so many times its noise"}}};
}

struct SensorFailure {
  FailureKind kind = FailureKind::none;
  double at = 0.0;
  double by = 0.0;
  double chance = 0.0;
  double lasts = 0.0;

  static constexpr auto fields() {
    using S = SensorFailure;
    return describe(field<&S::kind>("", "how it fails"), field<&S::at>("s", "when it begins, or may begin"),
                    field<&S::by>("", "the amount, in the unit of what it measures; of noise: times as much"),
                    field<&S::chance>("1/s", "rate at which it begins from then on; 0: it begins then"),
                    field<&S::lasts>("s", "after its begin it is sound again; 0: never").in(0, 1e9));
  }
};

/// A sensor's failure in one run.
class FailingSensor {
 public:
  /// What a reading has beside the truth.
  struct Error {
    double bias = 0.0;
    double noise = 1.0;  // times its own
  };

  FailingSensor() = default;
  FailingSensor(const SensorFailure& failure, std::uint64_t seed)
      : failure_(failure), begin_(draw_begin(failure.at, failure.chance, seed)), noise_(seed + 1) {}

  FailureKind now(double seconds) const {
    return lasts_at(seconds, begin_, failure_.lasts) ? failure_.kind : FailureKind::none;
  }

  /// Of the reading at that time.
  Error error(double seconds) {
    switch (now(seconds)) {
      case FailureKind::biased: return {failure_.by, 1.0};
      case FailureKind::drifting: return {failure_.by * (seconds - begin_), 1.0};
      case FailureKind::jumping:
        return {noise_.uniform() < 0.5 ? 0.0 : noise_.uniform() < 0.5 ? failure_.by : -failure_.by, 1.0};
      case FailureKind::noisy: return {0.0, failure_.by};
      case FailureKind::none:
      case FailureKind::lost:
      case FailureKind::stuck: break;
    }
    return {};
  }

  void serialize(Archive& archive) { archive(noise_); }

 private:
  SensorFailure failure_{};
  double begin_ = 0.0;
  Noise noise_{0};
};

}  // namespace jarol::vehicles
