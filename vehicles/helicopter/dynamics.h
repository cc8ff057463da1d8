// How the helicopter moves, whatever integrates its motion: plain numbers in and out. C++17 suffices to include it.
#pragma once

#include <string>

#include "vehicles/helicopter/body.h"

namespace jarol::vehicles {

/// Where the rotors' settings go in the next step, and the wind, which is constant in it.
struct HelicopterCommand {
  std::array<double, 4> settings{};
  fossen::Vector3 wind_n{};
  double payload = 0.0;  // kg
};

class HelicopterDynamics {
 public:
  virtual ~HelicopterDynamics() = default;

  static constexpr long step_nanoseconds = 5'000'000;

  /// One step, in five parts while the ground is touched or could be within it; throws NoState if the state is not
  /// finite after it.
  void step(const HelicopterCommand& command);

  const HelicopterMotion& motion() const { return motion_; }
  /// The rotors' settings reached.
  const std::array<double, 4>& settings() const { return input_.from; }
  /// Their thrusts, each as a part of its full one, far from the ground and in air at rest.
  std::array<double, 4> thrusts() const;
  /// What an accelerometer in the centre of gravity measures in body axes: all forces but the weight, per mass.
  fossen::Vector3 specific_force() const;

  /// Between two steps. Restored into a plant of the same body it goes on to the bit.
  void serialize(Archive& archive);

 protected:
  /// `settings`: those that the rotors have reached at the start.
  HelicopterDynamics(const HelicopterBody& body, const HelicopterMotion& start, const std::array<double, 4>& settings);

  const HelicopterBody& body() const { return body_; }
  static double seconds_of(long nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

 private:
  /// Integrates from one time to another under one input; throws std::exception if it notices that it can't.
  virtual HelicopterMotion advance(const HelicopterInput& input, double from, double to) = 0;
  /// Of what `advance` integrates, at a time.
  virtual void serialize_state(Archive& archive, double time) = 0;

  void advance_to(long nanoseconds);
  bool near_ground() const;

  HelicopterBody body_;
  HelicopterInput input_;
  HelicopterMotion motion_;
  bool near_ground_ = true;  // in this step
  long now_ = 0;
  std::string failure_;
};

}  // namespace jarol::vehicles
