// The submarine as a plain loop has it: Eigen, classic Runge-Kutta, no Simbody, no sensors.
#pragma once

#include <Eigen/Dense>

#include "vehicles/submarine/coefficients.h"

namespace jarol::bench {

class PlainSubmarine {
 public:
  explicit PlainSubmarine(const vehicles::SubmarineParameters& parameters);

  /// A step of some seconds with the propeller at that speed, rad/s.
  void step(double seconds, double propeller);

  double depth() const { return state_[2]; }
  double surge() const { return state_[7]; }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using State = Eigen::Matrix<double, 13, 1>;  // position, quaternion (x y z w), velocities

  State calc_rate(const State& state, double propeller) const;

  Matrix6 M_, M_inverse_, linear_, lift_, quadratic_;
  vehicles::SubmarineBody body_;
  State state_;
};

}  // namespace jarol::bench
