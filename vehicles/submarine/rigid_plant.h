// The submarine's motion as that of one rigid body, under the forces that it has in Simbody: for campaigns.
#pragma once

#include "vehicles/mechanics/rigid_body.h"
#include "vehicles/sea/waves.h"
#include "vehicles/submarine/motion.h"

namespace jarol::vehicles {

class RigidSubmarine : public SubmarineMotion {
 public:
  RigidSubmarine(const SubmarineBody& body, const Waves& waves, const PlantState& start);

  void step(const SubmarineInput& input) override;
  void serialize(Archive& archive) override { archive(state_, input_.propeller, input_.fins, steps_); }
  PlantState state() const override;

 private:
  fossen::Vector6 acceleration(const Eigen::Vector3d& p_n, const Vector6d& nu, const Eigen::Matrix3d& R_nb,
                               double seconds) const;

  SubmarineBody body_;
  Waves waves_;
  RigidState state_;
  SubmarineInput input_;  // of the latest step
  std::int64_t steps_ = 0;
};

}  // namespace jarol::vehicles
