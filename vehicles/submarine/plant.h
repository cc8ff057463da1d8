// The submarine's motion in Simbody.
#pragma once

#include <memory>

#include "vehicles/sea/waves.h"
#include "vehicles/submarine/motion.h"

namespace jarol::vehicles {

class SubmarinePlant : public SubmarineMotion {
 public:
  SubmarinePlant(const SubmarineBody& body, const Waves& waves, const PlantState& start);
  ~SubmarinePlant() override;

  void step(const SubmarineInput& input) override;
  void serialize(Archive& archive) override;
  PlantState state() const override;

 private:
  struct Simulation;
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace jarol::vehicles
