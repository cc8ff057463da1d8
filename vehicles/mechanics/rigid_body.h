// One rigid body that moves freely: place, attitude and velocity, integrated in steps of one length by the methods that
// Simbody's integrators of the vehicles use: Merson's (1957; fourth order, five evaluations) and Kutta's (1901; third
// order, three). The attitude is a unit quaternion, so that no attitude is singular.
#pragma once

#include <Eigen/Geometry>
#include <initializer_list>

#include "graph/math/rotations.h"
#include "graph/values/archive.h"
#include "vehicles/mechanics/fossen.h"

namespace jarol::vehicles {

struct RigidState {
  Eigen::Vector3d p_n = Eigen::Vector3d::Zero();             // of the origin of body axes, NED
  Eigen::Quaterniond q_nb = Eigen::Quaterniond::Identity();  // turns vectors of body axes into NED
  Eigen::Vector3d v_n = Eigen::Vector3d::Zero();             // of that origin
  Eigen::Vector3d omega_n = Eigen::Vector3d::Zero();

  Eigen::Matrix3d R_nb() const { return q_nb.normalized().toRotationMatrix(); }

  void serialize(Archive& archive) {
    for (Eigen::Vector3d* part : {&p_n, &v_n, &omega_n}) archive.bytes(part->data(), 3 * sizeof(double));
    archive.bytes(q_nb.coeffs().data(), 4 * sizeof(double));
  }
};

/// As forces are computed with it.
inline fossen::Vector3 plain(const Eigen::Vector3d& x) { return {x[0], x[1], x[2]}; }

/// Rates of a state.
struct RigidRates {
  Eigen::Vector3d p_dot;
  Eigen::Vector4d q_dot;
  Eigen::Vector3d v_dot;
  Eigen::Vector3d omega_dot;
};

struct Weighted {
  double weight;
  const RigidRates& rates;
};

inline RigidState moved(RigidState s, double time, std::initializer_list<Weighted> all) {
  for (const Weighted& each : all) {
    s.p_n += time * each.weight * each.rates.p_dot;
    s.q_nb.coeffs() += time * each.weight * each.rates.q_dot;
    s.v_n += time * each.weight * each.rates.v_dot;
    s.omega_n += time * each.weight * each.rates.omega_dot;
  }
  return s;
}

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Velocity in body axes: linear, then angular.
inline Vector6d nu_of(const RigidState& s, const Eigen::Matrix3d& R_nb) {
  Vector6d nu;
  nu << R_nb.transpose() * s.v_n, R_nb.transpose() * s.omega_n;
  return nu;
}

/// Rates under accelerations of the origin, in NED, and of the rotation, in body axes.
inline RigidRates rates_of(const RigidState& at, const Eigen::Matrix3d& R_nb, const Eigen::Vector3d& v_dot_n,
                           const Eigen::Vector3d& omega_dot_b) {
  const Eigen::Quaterniond spin(0.0, at.omega_n[0], at.omega_n[1], at.omega_n[2]);
  return {at.v_n, 0.5 * (spin * at.q_nb).coeffs(), v_dot_n, R_nb * omega_dot_b};
}

/// One step from time t to t + h by Kutta's method; `rates(state, t)` gives the rates.
template <class Rates>
RigidState kutta_step(const RigidState& s, double t, double h, const Rates& rates) {
  const RigidRates k1 = rates(s, t);
  const RigidRates k2 = rates(moved(s, h / 2.0, {{1.0, k1}}), t + h / 2.0);
  const RigidRates k3 = rates(moved(s, h, {{-1.0, k1}, {2.0, k2}}), t + h);
  RigidState end = moved(s, h / 6.0, {{1.0, k1}, {4.0, k2}, {1.0, k3}});
  end.q_nb.normalize();
  return end;
}

/// One step by Merson's method; `nu_dot(p_n, nu, R_nb, t)` gives the rate of nu in body axes.
template <class Acceleration>
RigidState merson_step(const RigidState& s, double t, double h, const Acceleration& nu_dot) {
  const auto rates = [&](const RigidState& at, double time) {
    const Eigen::Matrix3d R_nb = at.R_nb();
    const Vector6d nu = nu_of(at, R_nb), dot = nu_dot(at.p_n, nu, R_nb, time);
    // body axes turn themselves
    const Eigen::Vector3d v_dot_b = dot.head<3>() + nu.tail<3>().cross(nu.head<3>());
    return rates_of(at, R_nb, R_nb * v_dot_b, dot.tail<3>());
  };
  const RigidRates k1 = rates(s, t);
  const RigidRates k2 = rates(moved(s, h / 3.0, {{1.0, k1}}), t + h / 3.0);
  const RigidRates k3 = rates(moved(s, h / 6.0, {{1.0, k1}, {1.0, k2}}), t + h / 3.0);
  const RigidRates k4 = rates(moved(s, h / 8.0, {{1.0, k1}, {3.0, k3}}), t + h / 2.0);
  const RigidRates k5 = rates(moved(s, h / 2.0, {{1.0, k1}, {-3.0, k3}, {4.0, k4}}), t + h);
  RigidState end = moved(s, h / 6.0, {{1.0, k1}, {4.0, k4}, {1.0, k5}});
  end.q_nb.normalize();
  return end;
}

}  // namespace jarol::vehicles
