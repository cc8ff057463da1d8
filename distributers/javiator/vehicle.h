// The helicopter as the core sees it: what its sensors tell comes in, motor signals go out.
#pragma once

#include "distributers/interfaces/any_distributer.h"
#include "graph/registry.h"
#include "tasks/values/javiator.h"

namespace jarol::distributers {

/// Speaks the JAviator's protocol: JaviatorData in; MotorSignals, SwitchState and ShutDown out.
class JaviatorVehicle : public AnyDistributer {
 public:
  static DistributerClass describe_class();

  const messages::MessageSet& message_set() const override;
  void receive(messages::MessageRef message) override;
  bool take(std::size_t channel, void* value) override;
  void hand_over(std::size_t channel, const void* value, messages::Receiver& system) override;
  void take_over(std::size_t channel, const void* value, messages::Receiver& system) override;

 private:
  tasks::JaviatorSensors sensors_{};
  bool fresh_ = false;
  bool unlocked_ = false;
  std::uint16_t id_ = 0;
};

}  // namespace jarol::distributers
