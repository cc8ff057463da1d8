// The helicopter's motion in Simbody.
#pragma once

#include <memory>

#include "vehicles/helicopter/dynamics.h"

namespace jarol::vehicles {

class HelicopterPlant : public HelicopterDynamics {
 public:
  HelicopterPlant(const HelicopterBody& body, const HelicopterMotion& start,
                  const std::array<double, 4>& settings = {});
  ~HelicopterPlant() override;

 private:
  HelicopterMotion advance(const HelicopterInput& input, double from, double to) override;
  void serialize_state(Archive& archive, double time) override;

  struct Simulation;
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace jarol::vehicles
