// Four feet, and what else may touch level ground at z = 0: springs that only push, and friction that holds. Plain
// C++17.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "graph/values/archive.h"
#include "vehicles/mechanics/fossen.h"

namespace jarol::vehicles {

constexpr std::size_t foot_count = 4;
constexpr std::size_t contact_count = 13;  // feet, rotors' hubs, their outermost tips, the top

struct Feet {
  std::array<fossen::Vector3, contact_count> r_b{};        // feet first
  double reach = std::numeric_limits<double>::infinity();  // m, no contact is further from the centre of gravity
  double stiffness = 1.0;                                  // of one foot, N/m
  double dissipation = 0.0;  // s/m, after Hunt and Crossley, "Coefficient of Restitution ...", 1975
  double friction = 0.0;
  double grip_stiffness = 1.0;  // along the ground, N/m
  double grip_damping = 0.0;    // N s/m
};

/// Where a foot grips the ground. Friction is a spring to this place, so that nothing creeps; it is dragged along where
/// friction does not suffice.
struct FootAnchor {
  double x = 0.0, y = 0.0;

  void serialize(Archive& archive) { archive(x, y); }
};

/// A foot's place and velocity in NED.
struct FootMotion {
  fossen::Vector3 p_n{};
  fossen::Vector3 v_n{};
};

/// The ground's force on one foot, NED.
fossen::Vector3 calc_foot_force(const Feet& feet, const FootMotion& foot, const FootAnchor& anchor);

/// Where the foot grips after it has moved.
FootAnchor drag_along(const Feet& feet, const FootMotion& foot, const FootAnchor& anchor);

}  // namespace jarol::vehicles
