// The submarine as a vehicle: takes IMC commands for its thruster and its four servos, tells its state as
// SimulatedState.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "vehicles/submarine_parameters.h"
#include "vehicles/vehicle.h"

namespace jarol::vehicles {

class SubmarinePlant;

/// Steps of 10 ms. Starts with fins neutral and propeller still; commands that are not finite numbers are not taken.
class Submarine : public Vehicle {
 public:
  /// Throws std::runtime_error if no body can have these parameters.
  explicit Submarine(const SubmarineParameters& parameters);
  ~Submarine() override;

  std::chrono::nanoseconds grid() const override;
  void accept(messages::MessageRef command) override;
  /// Throws std::runtime_error once the state is no longer finite.
  void step() override;
  void sense(messages::Receiver& receiver) const override;

 private:
  SubmarineParameters parameters_;
  std::unique_ptr<SubmarinePlant> plant_;
  std::array<double, 4> servo_commands_{};
  std::array<double, 4> servos_{};
  double thruster_command_ = 0.0;
  double propeller_ = 0.0;  // rad/s
  std::int64_t steps_ = 0;
};

}  // namespace jarol::vehicles
