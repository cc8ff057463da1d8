// The helicopter's motion as that of one rigid body, under the forces that it has in Simbody: for campaigns.
#pragma once

#include "vehicles/helicopter/dynamics.h"
#include "vehicles/mechanics/rigid_body.h"

namespace jarol::vehicles {

class RigidHelicopter : public HelicopterDynamics {
 public:
  RigidHelicopter(const HelicopterBody& body, const HelicopterMotion& start,
                  const std::array<double, 4>& settings = {});

 private:
  HelicopterMotion advance(const HelicopterInput& input, double from, double to) override;
  void serialize_state(Archive& archive, double) override { archive(state_); }

  RigidState state_;
};

}  // namespace jarol::vehicles
