// What moves the submarine's propeller and fins: commands, their time-out, power, failures, lag, slew and
// limits.
#pragma once

#include <array>
#include <cstdint>

#include "vehicles/submarine/body.h"
#include "vehicles/submarine/parameters.h"

namespace jarol::vehicles {

class SubmarineActuation {
 public:
  /// Throws InputError if no actuators can have these parameters.
  explicit SubmarineActuation(const SubmarineParameters& parameters, std::uint64_t seed = 0);

  // what is not a finite number is not taken
  void command_thruster(double actuation);
  void command_servo(std::size_t servo, double angle);

  /// A step of 10 ms; returns what the plant sees over it. Without power the propeller stops, and fins stay where they
  /// are.
  SubmarineInput step(bool powered = true);

  double propeller() const { return propeller_; }  // rad/s
  const std::array<double, 4>& servos() const { return servos_; }

  void serialize(Archive& archive) {
    archive(thruster_command_, servo_commands_, thruster_silence_, servo_silence_, propeller_, servos_, steps_);
  }

 private:
  ServoParameters servo_parameters_;
  ThrusterParameters thruster_;
  bool at_start_of_step_ = false;
  std::int64_t timeout_ = 0;  // steps, 0 for none
  double thruster_command_ = 0.0;
  std::array<double, 4> servo_commands_{};
  std::int64_t thruster_silence_ = 0;  // steps since the last command
  std::array<std::int64_t, 4> servo_silence_{};
  double propeller_ = 0.0;
  std::array<double, 4> servos_{};
  std::array<FailingActuator, 4> failing_fins_;
  FailingActuator failing_propeller_;
  std::int64_t steps_ = 0;
};

}  // namespace jarol::vehicles
