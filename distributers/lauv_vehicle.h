// The submarine as the core sees it: its motion comes in, its actuation goes out.
#pragma once

#include "distributers/adapter.h"
#include "graph/registry.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {

/// Speaks IMC: SimulatedState in, SetThrusterActuation and SetServoPosition out.
class LauvVehicle : public Adapter {
 public:
  static DistributerClass describe_class();

  const messages::MessageSet& message_set() const override;
  void receive(messages::MessageRef message) override;
  bool take(std::size_t channel, void* value) override;
  void hand_over(std::size_t channel, const void* value, messages::Receiver& system) override;

 private:
  tasks::Motion motion_{};
  bool fresh_ = false;
};

/// The submarine's operator: setpoints or a bare actuation come in, reports or the bare motion go out.
DistributerClass describe_lauv_operator();

}  // namespace jarol::distributers
