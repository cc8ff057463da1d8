// A force on one body that follows an input from outside. Includes Simbody: for plants only.
#pragma once

#include <SimTKsimbody.h>

namespace jarol::vehicles {

/// The input is a discrete variable of the state: a plain member would go stale behind the state's caches.
template <class Input>
class ForceWithInput : public SimTK::Force::Custom::Implementation {
 public:
  ForceWithInput(const SimTK::GeneralForceSubsystem& forces, const SimTK::MobilizedBody& mobilized)
      : mobilized_(mobilized), forces_(forces) {}

  double calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

  void realizeTopology(SimTK::State& state) const override {
    input_ = forces_.allocateDiscreteVariable(state, SimTK::Stage::Dynamics, new SimTK::Value<Input>());
  }

  void set_input(SimTK::State& state, const Input& input) const {
    SimTK::Value<Input>::updDowncast(forces_.updDiscreteVariable(state, input_)).upd() = input;
  }

 protected:
  const Input& input(const SimTK::State& state) const {
    return SimTK::Value<Input>::downcast(forces_.getDiscreteVariable(state, input_)).get();
  }

  const SimTK::MobilizedBody& mobilized_;

 private:
  const SimTK::GeneralForceSubsystem& forces_;
  mutable SimTK::DiscreteVariableIndex input_;
};

}  // namespace jarol::vehicles
