#include "distributers/links/simulation.h"

#include "graph/language/quantities.h"

namespace jarol::distributers {

SimulationChannels::SimulationChannels(std::unique_ptr<vehicles::Stepped> vehicle, std::unique_ptr<Adapter> adapter)
    : vehicle_(std::move(vehicle)), adapter_(std::move(adapter)), to_vehicle_(*vehicle_) {}

void SimulationChannels::reach(Duration instant) {
  // sensors speak at every step of the grid, whether or not anyone listens: nothing depends on who looks
  if (!sensed_) {
    vehicle_->sense(*adapter_);
    sensed_ = true;
  }
  while (at_ + vehicle_->grid() <= instant) {
    vehicle_->step();
    at_ += vehicle_->grid();
    vehicle_->sense(*adapter_);
  }
}

std::string SimulationChannels::mishap() const {
  const auto mishap = vehicle_->mishap();
  return mishap ? mishap->text + ", at " + seconds_text(mishap->instant) + " s" : "";
}

bool SimulationChannels::take(std::size_t channel, void* value) { return adapter_->take(channel, value); }

void SimulationChannels::hand_over(std::size_t channel, const void* value) {
  adapter_->hand_over(channel, value, to_vehicle_);
}

}  // namespace jarol::distributers
