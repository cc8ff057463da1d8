// The submarine as a body in water: matrices, hull, fins, propeller, and the acceleration they give it. Plain C++17.
#pragma once

#include <array>

#include "vehicles/mechanics/fossen.h"
#include "vehicles/sea/hydrostatics.h"
#include "vehicles/sea/sea_floor.h"

namespace jarol::vehicles {

struct SubmarineBody {
  fossen::Matrix6 M_rb{};
  fossen::Matrix6 M_inverse{};  // of M_rb + M_a
  fossen::Matrix6 M_a{};
  fossen::Damping D{};
  FloatingHull hull{};
  double displaced = 0.0;  // mass of the water that the hull displaces
  SeaFloor floor{};

  struct Fin {
    fossen::Vector3 r_b{};
    fossen::Vector3 lift_b{};  // direction of lift at a positive angle when going ahead
  };
  std::array<Fin, 4> fins{};
  double fin_lift = 0.0;   // per u|u| and angle
  double fin_drag = 0.0;   // per u|u| and angle squared
  double fin_stall = 0.0;  // no more lift beyond this angle
  double fin_half_span = 0.0;

  struct Propeller {
    double x = 0.0;
    double radius = 0.0;
    double thrust = 0.0;   // per n|n|
    double advance = 0.0;  // less thrust per |n| and speed ahead
    double limit = 0.0;
  } propeller;
};

/// What the actuators do, constant over a step: speed of the propeller, rad/s, and angles of the fins.
struct SubmarineInput {
  double propeller = 0.0;
  std::array<double, 4> fins{};
};

/// The water where the body is.
struct Surroundings {
  Immersion at;                      // below the surface there
  double z = 0.0;                    // below still water
  fossen::Vector3 velocity_b{};      // of the water
  fossen::Vector3 acceleration_b{};  // of the water as it moves
};

/// Thrust in deep water at that speed ahead through it.
double calc_thrust(const SubmarineBody::Propeller& propeller, double n, double speed);

/// nu_dot from M_rb nu_dot + C_rb nu + M_a nu_r_dot + C_a nu_r + D nu_r + g(eta) = tau, nu_r being the velocity through
/// the water; what pushes the water pushes the hull in its place as well (Froude, Krylov).
fossen::Vector6 calc_nu_dot(const SubmarineBody& body, const Surroundings& around, const fossen::Vector6& nu,
                            const SubmarineInput& input);

}  // namespace jarol::vehicles
