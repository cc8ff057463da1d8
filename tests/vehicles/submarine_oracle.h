// The submarine a second time, for comparison: other state, other equations, other integrator, no line shared.
//
// Kirchhoff (Lamb, "Hydrodynamics", 1932, art. 120): linear and angular momentum of hull and water change by the outer
// forces alone. Both are integrated in NED, where no Coriolis term appears, and velocities are solved from them.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "vehicles/submarine_parameters.h"

namespace jarol::test {

class SubmarineOracle {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  SubmarineOracle(const vehicles::SubmarineParameters& parameters, double depth, double surge);

  /// Advances under constant thrust and angles of fins, by classic Runge-Kutta steps of at most 1 ms.
  void advance(double seconds, double thrust, const std::array<double, 4>& fins);

  Eigen::Vector3d position() const { return state_.segment<3>(0); }
  Eigen::Matrix3d rotation() const;
  Vector6 velocity() const { return calc_velocity(state_); }

 private:
  using State = Eigen::Matrix<double, 13, 1>;  // position, quaternion (x y z w), linear and angular momentum about NED

  State calc_rate(const State& state, double thrust, const std::array<double, 4>& fins) const;
  Vector6 calc_velocity(const State& state) const;
  Vector6 calc_loads(const Vector6& nu, double z, const Eigen::Vector3d& down) const;

  vehicles::SubmarineParameters parameters_;
  Eigen::Matrix<double, 6, 6> mass_;
  State state_;
};

}  // namespace jarol::test
