// The submarine as the core sees it: its motion comes in, its actuation goes out.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>

#include "distributers/interfaces/any_distributer.h"
#include "graph/registry.h"
#include "tasks/values/instruments.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {

/// Speaks IMC: SimulatedState or EstimatedState, whichever came last, and what instruments tell in;
/// SetThrusterActuation and SetServoPosition out. A field that is no number beside others that are is one that the
/// instrument does not measure; a reading that is not finite otherwise is counted and left out.
class LauvVehicle : public AnyDistributer {
 public:
  static DistributerClass describe_class();

  const messages::MessageSet& message_set() const override;
  void receive(messages::MessageRef message) override;
  void listen_at(const std::string& address) override { address_ = address; }
  void announce(Duration instant, messages::Receiver& all) override;
  std::uint64_t non_finite_inputs() const override { return non_finite_inputs_; }
  bool take(std::size_t channel, void* value) override;
  void hand_over(std::size_t channel, const void* value, messages::Receiver& system) override;

 private:
  void receive_motion(messages::MessageRef message);
  void receive_hull(messages::MessageRef message);
  void place(double latitude, double longitude);
  void note(tasks::Reading& reading, double value);
  void note(tasks::VectorReading& reading, double x, double y, double z);
  bool all_finite(std::initializer_list<double> values);  // else that is counted

  tasks::Motion motion_{};
  tasks::Instruments instruments_{};
  bool motion_fresh_ = false, instruments_fresh_ = false;
  std::uint64_t non_finite_inputs_ = 0;
  double latitude_ = 0, longitude_ = 0;  // of the first fix
  std::string address_;
  std::optional<Duration> announced_;
};

}  // namespace jarol::distributers
