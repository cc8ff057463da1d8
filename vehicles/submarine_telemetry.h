// What DUNE tells a console about a simulated submarine beside its sensors.
#pragma once

#include <cstdint>

#include "distributers/messages/imc.h"
#include "vehicles/vehicle.h"

namespace jarol::vehicles {

/// Passes on what the submarine tells. With each SimulatedState, one every 10 ms, it adds four ServoPosition, with each
/// fifth an EstimatedState, here the true one, with each hundredth a Heartbeat: DUNE's rates.
class SubmarineTelemetry : public messages::Receiver {
 public:
  SubmarineTelemetry(const Vehicle& vehicle, messages::Receiver& to) : vehicle_(vehicle), to_(to) {}

  void receive(messages::MessageRef message) override;

 private:
  void tell_servos();
  void tell_estimate(const messages::imc::SimulatedState& truth);

  const Vehicle& vehicle_;
  messages::Receiver& to_;
  std::int64_t states_ = 0;
};

}  // namespace jarol::vehicles
