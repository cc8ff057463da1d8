// The helicopter as a vehicle: takes the JAviator's motor signals and switches, answers with what its sensors measure.
#pragma once

#include <memory>

#include "distributers/interfaces/vehicle.h"
#include "distributers/messages/javiator.h"
#include "graph/values/type_of.h"
#include "vehicles/air/wind.h"
#include "vehicles/helicopter/battery.h"
#include "vehicles/helicopter/io.h"
#include "vehicles/helicopter/judge.h"
#include "vehicles/helicopter/packets.h"
#include "vehicles/helicopter/robostix.h"
#include "vehicles/helicopter/sensors.h"
#include "vehicles/mechanics/actuator_failure.h"

namespace jarol::vehicles {

class HelicopterDynamics;

/// Steps of 5 ms. Motor signals act at once and are answered a step later; the IMU values of an answer were measured
/// when the answer before had been sent. Signals and answers may be lost on their way; switches, sent once, are not.
class Helicopter : public Vehicle {
 public:
  using Parameters = HelicopterParameters;
  using Inputs = HelicopterInputs;
  using Outputs = HelicopterOutputs;
  using Truth = HelicopterTruth;

  /// `seed`: of all noise. Throws InputError if no body can have these parameters.
  explicit Helicopter(const HelicopterParameters& parameters, std::uint64_t seed = 0);
  ~Helicopter() override;

  std::chrono::nanoseconds grid() const override;
  void accept(messages::MessageRef command) override;
  void step() override;
  void sense(messages::Receiver& receiver) const override;
  const Type* true_type() const override { return &type_of<HelicopterTruth>(); }
  const void* true_values() const override { return &judge_.truth(); }
  std::optional<Mishap> mishap() const override { return judge_.mishap(); }
  std::string unrest() const override { return judge_.unrest(); }
  void serialize(Archive& archive) override;
  VehicleState state() const override;
  /// z is that of the centre of gravity, negative above the ground.
  void place(const VehicleState& state) override;
  /// Unlocks the motors.
  void command(const void* inputs) override;
  const void* outputs() const override { return &outputs_; }

  /// The truth, for tests and for looking on.
  const HelicopterMotion& motion() const;
  double voltage() const { return voltage_; }

 private:
  HelicopterSensors::Scene scene() const;
  HelicopterSensors::Scene scene_without_force() const;  // which takes long to find, and only the IMU measures
  void report_outputs(double current);
  void hear_signals();

  HelicopterParameters parameters_;
  std::unique_ptr<HelicopterDynamics> plant_;
  Robostix robostix_;
  Battery battery_;
  Wind wind_;
  HelicopterSensors sensors_;
  messages::javiator::JaviatorData answer_{};
  PacketLine<messages::javiator::MotorSignals> signals_;
  PacketLine<messages::javiator::JaviatorData> answers_;
  PacketLine<messages::javiator::SonarData> sonars_;
  double voltage_ = 0.0;
  HelicopterOutputs outputs_;
  HelicopterJudge judge_;
  std::int64_t nanoseconds_ = 0;
  std::uint64_t seed_ = 0;
  std::array<FailingActuator, 4> motors_{};
  std::array<double, 4> settings_{};  // of the motors; a stuck one keeps its own
  double payload_until_ = 0.0;        // s
};

}  // namespace jarol::vehicles
