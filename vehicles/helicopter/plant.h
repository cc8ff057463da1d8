// The helicopter's motion in Simbody, hidden from everything else: plain numbers in and out. C++17 suffices to include
// it.
#pragma once

#include <memory>

#include "vehicles/helicopter/body.h"

namespace jarol::vehicles {

/// Where the rotors' settings go in the next step, and the wind, which is constant in it.
struct HelicopterCommand {
  std::array<double, 4> settings{};
  fossen::Vector3 wind_n{};
  double payload = 0.0;  // kg
};

class HelicopterPlant {
 public:
  /// `settings`: those that the rotors have reached at the start.
  HelicopterPlant(const HelicopterBody& body, const HelicopterMotion& start,
                  const std::array<double, 4>& settings = {});
  ~HelicopterPlant();

  static constexpr long step_nanoseconds = 5'000'000;

  /// One step, in five parts while the ground is touched or could be within it; throws std::runtime_error if the state
  /// is not finite after it.
  void step(const HelicopterCommand& command);

  const HelicopterMotion& motion() const;
  /// The rotors' settings reached.
  const std::array<double, 4>& settings() const;
  /// What an accelerometer in the centre of gravity measures in body axes: all forces but the weight, per mass.
  fossen::Vector3 specific_force() const;

  /// Between two steps. Restored into a plant of the same body it goes on to the bit.
  void serialize(Archive& archive);

 private:
  struct Simulation;
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace jarol::vehicles
