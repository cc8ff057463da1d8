// The submarine a second time, for comparison: other state, other equations, other integrator, no line shared.
//
// Momenta of the hull with the water that it takes along, after Kirchhoff (Lamb, "Hydrodynamics", 1932, art. 120), are
// integrated in NED, over ground: the current is subtracted where the flow past the hull is asked for, and the waves'
// accelerations are differences of velocities along the water's way.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "vehicles/submarine/parameters.h"

namespace jarol::test {

class SubmarineOracle {
 public:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// Starts level and heading north, with that speed through still water.
  SubmarineOracle(const vehicles::SubmarineParameters& parameters, double depth, double surge);

  /// Advances under constant speed of the propeller and angles of the fins, by classic Runge-Kutta steps of 1 ms at
  /// most.
  void advance(double seconds, double propeller, const std::array<double, 4>& fins);

  Eigen::Vector3d position() const { return state_.segment<3>(0); }
  Eigen::Matrix3d rotation() const;
  Vector6 velocity() const { return calc_velocity(state_); }

 private:
  // position, quaternion (x y z w), linear momentum, angular momentum about the body's origin; all in NED
  using State = Eigen::Matrix<double, 13, 1>;

  State calc_rate(double time, const State& state, double propeller, const std::array<double, 4>& fins) const;
  Vector6 calc_velocity(const State& state) const;
  Vector6 calc_loads(const Vector6& nu_r, double z, const Eigen::Vector3d& down) const;
  Vector6 calc_actuators(const Vector6& nu_r, double z, const Eigen::Vector3d& down, double propeller,
                         const std::array<double, 4>& fins) const;
  Eigen::Vector3d water(double time, const Eigen::Vector3d& place) const;
  double surface(double time, const Eigen::Vector3d& place) const;

  vehicles::SubmarineParameters parameters_;
  double density_ = 1.0;  // of that for which the coefficients hold
  Eigen::Matrix<double, 6, 6> added_;
  Eigen::Matrix<double, 6, 6> inverse_mass_;
  State state_;
  double time_ = 0.0;
};

}  // namespace jarol::test
