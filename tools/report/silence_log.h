// What a vehicle that is steered from outside did: when nobody steered it, what its actuators did then, where it ended.
#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "distributers/interfaces/vehicle.h"

namespace jarol::tools {

class SilenceLog {
 public:
  /// Without a message for longer its peer is silent.
  static constexpr std::chrono::milliseconds patience{500};

  /// Both outlive it.
  SilenceLog(const vehicles::Vehicle& vehicle, const vehicles::VehicleClass& vehicle_class)
      : vehicle_(vehicle), class_(vehicle_class) {}

  /// At each instant, in order: did messages come since the one before?
  void note(std::chrono::nanoseconds instant, bool heard);

  std::string to_text() const;
  nlohmann::ordered_json to_json() const;

 private:
  struct Silence {
    std::chrono::nanoseconds from{}, to{};
    vehicles::VehicleState state;   // at its end
    std::vector<double> actuators;  // likewise
  };
  static constexpr std::size_t max_kept = 100;

  const Type& actuators_type() const { return *class_.outputs->fields.front().type; }
  std::vector<double> actuators() const;
  std::string place_text(const vehicles::VehicleState& state, const std::vector<double>& actuators) const;
  nlohmann::ordered_json actuators_json(const std::vector<double>& actuators) const;

  const vehicles::Vehicle& vehicle_;
  const vehicles::VehicleClass& class_;
  std::chrono::nanoseconds now_{}, heard_{};  // heard_: or the start
  bool silent_ = false;
  std::uint64_t silences_ = 0;
  std::chrono::nanoseconds silent_for_{};  // all together
  std::vector<Silence> kept_;              // the first of them
};

}  // namespace jarol::tools
