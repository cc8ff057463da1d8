// The submarine as a vehicle: takes IMC commands for its thruster and its four servos, reports what its
// sensors read, and its true state as SimulatedState.
#pragma once

#include <cstdint>
#include <memory>

#include "distributers/interfaces/vehicle.h"
#include "graph/values/type_of.h"
#include "vehicles/sea/waves.h"
#include "vehicles/submarine/actuation.h"
#include "vehicles/submarine/io.h"
#include "vehicles/submarine/judge.h"
#include "vehicles/submarine/motion.h"
#include "vehicles/submarine/parameters.h"
#include "vehicles/submarine/sensors.h"

namespace jarol::vehicles {

/// Steps of 10 ms. Starts with fins neutral and propeller still; commands that are not finite numbers are not taken.
class Submarine : public Vehicle {
 public:
  using Parameters = SubmarineParameters;
  using Inputs = SubmarineInputs;
  using Outputs = SubmarineOutputs;
  using Truth = SubmarineTruth;

  /// Throws InputError if no body can have these parameters.
  explicit Submarine(const SubmarineParameters& parameters, std::uint64_t seed = 0);
  ~Submarine() override;

  std::chrono::nanoseconds grid() const override;
  void accept(messages::MessageRef command) override;
  void step() override;
  void sense(messages::Receiver& receiver) const override;
  const Type* true_type() const override { return &type_of<SubmarineTruth>(); }
  const void* true_values() const override { return &judge_.truth(); }
  std::optional<Mishap> mishap() const override { return judge_.mishap(); }
  std::string unrest() const override { return judge_.unrest(); }
  void serialize(Archive& archive) override;
  VehicleState state() const override;
  void place(const VehicleState& state) override;
  void command(const void* inputs) override;
  const void* outputs() const override { return &outputs_; }

 private:
  void sample();

  SubmarineParameters parameters_;
  std::uint64_t seed_;
  std::unique_ptr<SubmarineMotion> motion_;
  SubmarineActuation actuation_;
  SubmarineSensors sensors_;
  Power power_;
  Waves waves_;
  PlantState at_;
  std::int64_t steps_ = 0;
  SubmarineOutputs outputs_;
  SubmarineJudge judge_;
};

}  // namespace jarol::vehicles
