// The link to a vehicle that is simulated in another process, in lockstep with the logical clock: each grid step is
// granted, so that the digest is that of the same vehicle in this process.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "distributers/links/frames.h"
#include "distributers/links/simulation.h"

namespace jarol::distributers {

struct LinkType;

/// The link type `lockstep`.
LinkType lockstep_link();

/// Says what is wrong with a vehicle that has that grid, or nothing.
using CheckGrid = std::function<std::string(Duration grid)>;

struct LockstepOptions {
  std::optional<SecretKey> key{};
  /// With the whole answer to a question, and with a silence.
  std::chrono::milliseconds patience = FrameStream::usual_patience;
};

class RemoteVehicle;

class LockstepSystem : public ExternalSystem {
 public:
  LockstepSystem(const Address& peer, std::uint64_t seed, std::unique_ptr<AnyDistributer> distributer,
                 CheckGrid check_grid, LockstepOptions options = {});
  ~LockstepSystem() override;

  /// Connects, and has the vehicle begin. Throws FrameError, also if it is not one for this distributer and grid.
  void begin() override;
  void finish() override;
  bool outlives_run() const override { return true; }
  void flush() override;

  std::uint64_t non_finite_inputs() const override { return simulation_ ? simulation_->non_finite_inputs() : 0; }
  std::string mishap() const override { return simulation_ ? simulation_->mishap() : mishap_; }
  void reach(Duration instant) override { simulation_->reach(instant); }
  bool take(std::size_t channel, void* value) override { return simulation_->take(channel, value); }
  void hand_over(std::size_t channel, const void* value) override { simulation_->hand_over(channel, value); }
  void serialize(Archive&) override { throw NotSaveable("its vehicle is in another process, which can't be saved"); }

 private:
  Address peer_;
  std::uint64_t seed_;
  std::unique_ptr<AnyDistributer> distributer_;  // until it begins
  CheckGrid check_grid_;
  LockstepOptions options_;
  RemoteVehicle* vehicle_ = nullptr;  // the simulation's, while it runs
  std::unique_ptr<SimulatedSystem> simulation_;
  std::string mishap_;  // of the vehicle, when it is left
};

}  // namespace jarol::distributers
