// The submarine as DUNE's simulator VSIM moves it, for comparison with it: six accelerations of their own, explicit
// Euler steps of 10 ms, and an error that it has: its gyroscopic moments are made of masses, not of inertias.
#pragma once

#include "vehicles/submarine/motion.h"
#include "vehicles/submarine/parameters.h"

namespace jarol::vehicles {

class VsimPlant : public SubmarineMotion {
 public:
  /// Throws InputError if no body can have these parameters, or for a sea that VSIM does not know.
  VsimPlant(const SubmarineParameters& parameters, const PlantState& start);

  void step(const SubmarineInput& input) override;
  void serialize(Archive& archive) override;
  PlantState state() const override { return state_; }

 private:
  fossen::Vector6 calc_forces(const SubmarineInput& input) const;

  SubmarineBody body_;
  VsimParameters vsim_;
  PlantState state_;
  std::int64_t steps_ = 0;
};

}  // namespace jarol::vehicles
