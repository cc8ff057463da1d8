// The submarine as a body in water: matrices, hull, fins, propeller, and the acceleration they give it. Plain C++17.
#pragma once

#include <array>

#include "vehicles/fossen.h"
#include "vehicles/hydrostatics.h"

namespace jarol::vehicles {

struct SubmarineBody {
  fossen::Matrix6 M_rb{};
  fossen::Matrix6 M_inverse{};  // of M_rb + M_a
  fossen::Matrix6 M_a{};
  fossen::Damping D{};
  FloatingHull hull{};

  struct Fin {
    fossen::Vector3 r_b{};
    fossen::Vector3 lift_b{};  // direction of lift at a positive angle when going ahead
  };
  std::array<Fin, 4> fins{};
  double fin_lift = 0.0;   // per u|u| and angle
  double fin_drag = 0.0;   // per u|u| and angle squared
  double fin_stall = 0.0;  // no more lift beyond this angle
  double fin_half_span = 0.0;

  double propeller_x = 0.0;
  double propeller_radius = 0.0;
};

/// What the actuators do, constant over a step: thrust in deep water, angles of the fins.
struct SubmarineInput {
  double thrust = 0.0;
  std::array<double, 4> fins{};
};

/// nu_dot from (M_rb + M_a) nu_dot = tau - g(eta) - D nu - C_rb nu - C_a nu.
fossen::Vector6 calc_nu_dot(const SubmarineBody& body, const Immersion& at, const fossen::Vector6& nu,
                            const SubmarineInput& input);

}  // namespace jarol::vehicles
