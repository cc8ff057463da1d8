// The submarine as a vehicle: takes IMC commands for its thruster and its four servos, tells its state as
// SimulatedState.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "vehicles/submarine_body.h"
#include "vehicles/submarine_io.h"
#include "vehicles/submarine_parameters.h"
#include "vehicles/vehicle.h"

namespace jarol::vehicles {

class SubmarinePlant;

/// Steps of 10 ms. Starts with fins neutral and propeller still; commands that are not finite numbers are not taken.
class Submarine : public Vehicle {
 public:
  using Parameters = SubmarineParameters;
  using Inputs = SubmarineInputs;
  using Outputs = SubmarineOutputs;

  /// Throws std::runtime_error if no body can have these parameters.
  explicit Submarine(const SubmarineParameters& parameters, std::uint64_t seed = 0);
  ~Submarine() override;

  std::chrono::nanoseconds grid() const override;
  void accept(messages::MessageRef command) override;
  void step() override;
  void sense(messages::Receiver& receiver) const override;
  VehicleState state() const override;
  void place(const VehicleState& state) override;
  void command(const void* inputs) override;
  const void* outputs() const override { return &outputs_; }

 private:
  void command_thruster(double actuation);
  void command_servo(std::size_t servo, double angle);

  SubmarineParameters parameters_;
  SubmarineBody body_;
  std::unique_ptr<SubmarinePlant> plant_;
  std::array<double, 4> servo_commands_{};
  std::array<double, 4> servos_{};
  double thruster_command_ = 0.0;
  double propeller_ = 0.0;  // rad/s
  std::int64_t steps_ = 0;
  SubmarineOutputs outputs_;
};

}  // namespace jarol::vehicles
