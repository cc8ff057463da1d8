// Contact of the hull with a level sea floor: at the undersides of two spheres in its ends, as springs with damping and
// dry friction. Plain C++17.
#pragma once

#include "vehicles/sea/hydrostatics.h"

namespace jarol::vehicles {

struct SeaFloor {
  double depth = 0.0;        // z, below still water
  double half_length = 0.0;  // of the hull
  double radius = 0.0;       // of the hull
};

/// Force and moment on the body at that place with that velocity over ground, but for the current.
fossen::Vector6 floor_force(const SeaFloor& floor, const Immersion& at, const fossen::Vector6& nu);

}  // namespace jarol::vehicles
