// Where Simbody's Ground meets NED: they are the same axes. Only for units that include Simbody, which are C++17.
#pragma once

#include <SimTKsimbody.h>

#include "vehicles/mechanics/fossen.h"

namespace jarol::vehicles {

/// Force then moment in body axes -> Simbody's moment then force in Ground axes.
inline SimTK::SpatialVec to_ground(const SimTK::Rotation& R_nb, const fossen::Vector6& tau) {
  return {R_nb * SimTK::Vec3(tau[3], tau[4], tau[5]), R_nb * SimTK::Vec3(tau[0], tau[1], tau[2])};
}

/// Simbody's angular then linear velocity in Ground axes -> nu.
inline fossen::Vector6 to_body(const SimTK::Rotation& R_nb, const SimTK::SpatialVec& velocity) {
  const SimTK::Vec3 angular = ~R_nb * velocity[0];
  const SimTK::Vec3 linear = ~R_nb * velocity[1];
  return {linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]};
}

inline fossen::Vector3 to_body(const SimTK::Rotation& R_nb, const fossen::Vector3& v_n) {
  const SimTK::Vec3 v_b = ~R_nb * SimTK::Vec3(v_n[0], v_n[1], v_n[2]);
  return {v_b[0], v_b[1], v_b[2]};
}

/// The unit vector down, in body axes.
inline fossen::Vector3 down_in_body(const SimTK::Rotation& R_nb) { return {R_nb[2][0], R_nb[2][1], R_nb[2][2]}; }

}  // namespace jarol::vehicles
