// The link to a vehicle that is simulated in lockstep with the logical clock.
#pragma once

#include <memory>

#include "distributers/interfaces/any_distributer.h"
#include "distributers/interfaces/vehicle.h"
#include "runtime/external_system.h"

namespace jarol::distributers {

struct LinkType;

/// The link type `simulation`.
LinkType simulation_link();

class SimulatedSystem : public ExternalSystem {
 public:
  SimulatedSystem(std::unique_ptr<vehicles::SteppedVehicle> vehicle, std::unique_ptr<AnyDistributer> distributer);

  std::uint64_t non_finite_inputs() const override { return distributer_->non_finite_inputs(); }
  const Type* true_type() const override { return vehicle_->true_type(); }
  void copy_true_values(void* to) const override { copy_value(*true_type(), to, vehicle_->true_values()); }
  std::string mishap() const override;
  std::string unrest() const override { return vehicle_->unrest(); }
  void reach(Duration instant) override;
  bool take(std::size_t channel, void* value) override;
  void hand_over(std::size_t channel, const void* value) override;
  void serialize(Archive& archive) override;

 private:
  // What the distributer sends goes straight to the vehicle.
  struct ToVehicle : messages::Receiver {
    explicit ToVehicle(vehicles::SteppedVehicle& to) : vehicle(to) {}
    void receive(messages::MessageRef message) override { vehicle.accept(message); }
    vehicles::SteppedVehicle& vehicle;
  };

  std::unique_ptr<vehicles::SteppedVehicle> vehicle_;
  std::unique_ptr<AnyDistributer> distributer_;
  ToVehicle to_vehicle_;
  Duration at_{};
  bool sensed_ = false;  // at the start
};

}  // namespace jarol::distributers
