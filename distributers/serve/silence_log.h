// When nobody steered a vehicle that is steered from outside, and what its actuators did then.
#pragma once

#include <cstdint>
#include <vector>

#include "distributers/serve/vehicle_sink.h"

namespace jarol {

/// What the actuators do: the numbers in the first of the outputs of the vehicle's class.
std::vector<double> actuators_of(const vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class);

/// No message has come for longer than `SilenceLog::patience`.
struct Silence {
  std::chrono::nanoseconds from{}, to{};  // from: the last message, or the start
  vehicles::VehicleState state;           // at its end
  std::vector<double> actuators;          // likewise
};

class SilenceLog : public VehicleSink {
 public:
  static constexpr std::chrono::milliseconds patience{500};
  static constexpr std::size_t max_kept = 100;

  /// The class outlives it.
  explicit SilenceLog(const vehicles::VehicleClass& vehicle_class) : class_(vehicle_class) {}

  void add(const VehicleMoment& moment) override;

  std::uint64_t silences() const { return silences_; }
  /// All together.
  std::chrono::nanoseconds silent_for() const { return silent_for_; }
  /// The first of them.
  const std::vector<Silence>& kept() const { return kept_; }

 private:
  const vehicles::VehicleClass& class_;
  std::chrono::nanoseconds before_{}, heard_{};  // the instant before; the last message, or the start
  bool silent_ = false;
  std::uint64_t silences_ = 0;
  std::chrono::nanoseconds silent_for_{};
  std::vector<Silence> kept_;
};

}  // namespace jarol
