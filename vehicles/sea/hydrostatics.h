// Weight and buoyancy of a hull that may reach out of the water. The part of it under water is that of an ellipsoid of
// the hull's length and diameter, which has a closed form at any attitude, so that no energy appears or is lost on the
// way.
#pragma once

#include "vehicles/mechanics/fossen.h"

namespace jarol::vehicles {

/// What of eta water and gravity ask: depth of the body's origin, and the unit vector down in body axes.
struct Immersion {
  double z = 0.0;
  fossen::Vector3 down_b{0.0, 0.0, 1.0};
};

struct FloatingHull {
  double W = 0.0;          // weight
  double B = 0.0;          // buoyancy, fully immersed
  fossen::Vector3 r_bg{};  // centre of gravity; that of buoyancy is the origin
  fossen::Vector3 semi_axes{1.0, 1.0, 1.0};
};

/// Part of a sphere's volume below a plane, by the plane's height over its centre in radii: 0 at -1, 1 at 1.
double immersed_part(double height);

/// Part of the hull under water, and the centre of that part's volume.
struct Immersed {
  double part = 0.0;
  fossen::Vector3 centre_b{};
};
Immersed calc_immersed(const FloatingHull& hull, const Immersion& at);

/// -g(eta): force and moment of weight and buoyancy on the body.
fossen::Vector6 restoring_force(const FloatingHull& hull, const Immersed& immersed, const Immersion& at);

/// Depth of the origin at which the level hull rests; just under water if it is too heavy to float.
double calc_floating_depth(const FloatingHull& hull);

}  // namespace jarol::vehicles
