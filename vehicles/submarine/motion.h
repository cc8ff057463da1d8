// How the submarine moves, hidden from everything else: plain numbers in and out. C++17 suffices to include it.
#pragma once

#include "graph/values/archive.h"
#include "vehicles/submarine/body.h"

namespace jarol::vehicles {

/// eta = x, y, z of NED and phi, theta, psi (ZYX); nu = u, v, w, p, q, r, and its rate in body axes. Both in a frame
/// that the current carries along.
struct PlantState {
  fossen::Vector6 eta{};
  fossen::Vector6 nu{};
  fossen::Vector6 nu_dot{};

  void serialize(Archive& archive) { archive(eta, nu, nu_dot); }
};

class SubmarineMotion {
 public:
  virtual ~SubmarineMotion() = default;

  static constexpr double step_seconds = 0.01;

  /// One step under constant inputs; throws NoState if the state is not finite after it.
  virtual void step(const SubmarineInput& input) = 0;

  virtual PlantState state() const = 0;

  /// Between two steps. Restored into a motion of the same body it goes on to the bit.
  virtual void serialize(Archive& archive) = 0;
};

}  // namespace jarol::vehicles
