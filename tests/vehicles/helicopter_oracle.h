// The helicopter a second time, for comparison: other state, other equations, other integrator, no line shared.
//
// Momentum of the whole vehicle, rotors included, is integrated in NED, where neither Coriolis nor gyroscopic terms
// appear: P_dot = F, L_dot = M about the moving centre of gravity. The spin of the rotors is subtracted to find the
// rates. The rotors' lag is a differential equation, not its solution.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "vehicles/helicopter/parameters.h"

namespace jarol::test {

class HelicopterOracle {
 public:
  /// At rest and level in free air at that height of the centre of gravity, rotors at these settings.
  HelicopterOracle(const vehicles::HelicopterParameters& parameters, double height,
                   const std::array<double, 4>& settings);

  /// Advances under constant commanded settings and wind, by classic Runge-Kutta steps of at most 0.5 ms.
  void advance(double seconds, const std::array<double, 4>& settings, const Eigen::Vector3d& wind);

  Eigen::Vector3d position() const { return state_.segment<3>(0); }
  Eigen::Matrix3d rotation() const;
  Eigen::Vector3d rates() const;

 private:
  using State = Eigen::Matrix<double, 17, 1>;  // position, quaternion (x y z w), momentum, angular momentum, settings

  State calc_rate(const State& state, const Eigen::Vector4d& settings, const Eigen::Vector3d& wind) const;
  Eigen::Vector3d calc_spin(const State& state) const;

  vehicles::HelicopterParameters parameters_;
  State state_;
};

}  // namespace jarol::test
