// The state of what a Simbody integrator advances, in an archive. Includes Simbody: for plants only.
#pragma once

#include <Simbody.h>

#include "graph/values/archive.h"

namespace jarol::vehicles {

/// Between two calls of stepTo, with a fixed step: q, u and z; `time` is that of the last call. Discrete variables are
/// set again before each step. What is restored is not initialized anew, which would normalize its quaternions.
inline void serialize_state(Archive& archive, SimTK::Integrator& integrator, double time) {
  SimTK::Vector y = integrator.getAdvancedState().getY();
  archive.same(static_cast<std::uint64_t>(y.size()), "has a vehicle of another system");
  archive.bytes(&y[0], static_cast<std::size_t>(y.size()) * sizeof(double));
  archive.require(SimTK::isFinite(y.normSqr()), "has a vehicle where there is none");
  if (!archive.restores()) return;
  SimTK::State& state = integrator.updAdvancedState();
  state.setTime(time);
  state.updY() = y;
  integrator.reinitialize(SimTK::Stage::Topology, false);
}

}  // namespace jarol::vehicles
