// The helicopter as a plain loop has it: Eigen, classic Runge-Kutta, no Simbody, no sensors.
#pragma once

#include <Eigen/Dense>

#include "vehicles/helicopter/coefficients.h"

namespace jarol::bench {

class PlainHelicopter {
 public:
  /// In the air at that height, level and at rest, its rotors at the setting that holds it there.
  PlainHelicopter(const vehicles::HelicopterParameters& parameters, double height);

  /// A step of some seconds with the rotors as they are.
  void step(double seconds);

  double height() const { return -state_[2]; }

 private:
  using State = Eigen::Matrix<double, 13, 1>;  // position, quaternion (x y z w), velocities

  State calc_rate(const State& state, double time) const;

  vehicles::HelicopterBody body_;
  vehicles::HelicopterInput input_;
  State state_;
};

}  // namespace jarol::bench
