// The submarine's motion in Simbody, hidden from everything else: plain numbers in and out. C++17 suffices to include
// it.
#pragma once

#include <memory>

#include "vehicles/submarine_body.h"

namespace jarol::vehicles {

/// eta = x, y, z of NED and phi, theta, psi (ZYX); nu = u, v, w, p, q, r through the water.
struct PlantState {
  double eta[6] = {};
  double nu[6] = {};
};

class SubmarinePlant {
 public:
  SubmarinePlant(const SubmarineBody& body, const PlantState& start);
  ~SubmarinePlant();

  static constexpr double step_seconds = 0.01;

  /// One step under constant inputs; throws NoState if the state is not finite after it.
  void step(const SubmarineInput& input);

  PlantState state() const;

 private:
  struct Simulation;
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace jarol::vehicles
