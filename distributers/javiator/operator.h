// The helicopter's operator as the core sees it: commands come in, reports go out.
#pragma once

#include "distributers/interfaces/any_distributer.h"
#include "distributers/javiator/trim_file.h"
#include "graph/registry.h"
#include "tasks/values/gains.h"
#include "tasks/values/javiator.h"

namespace jarol::distributers {

struct JaviatorOperatorParameters {
  String trim_file;

  static constexpr auto fields() {
    return describe(field<&JaviatorOperatorParameters::trim_file>(
        "", "where the trim is kept from one run to the next; none: each begins without"));
  }
};

/// Speaks with the JAviator's control terminal as its flight controller does: GroundReport and TraceData out, which the
/// terminal answers with CommandData; switches, trim and shut-down in. Gains and idle signal that it sends are for the
/// JAviator's own laws. Over UDP, the first SwitchState of a new peer is a hello and switches nothing. Where a trim
/// file is named, the trim is read from it at the start and kept in it when the run ends, as the JAviator's controller
/// does.
class JaviatorOperator : public AnyDistributer {
 public:
  /// Throws std::invalid_argument if the trim file is none.
  explicit JaviatorOperator(const JaviatorOperatorParameters& parameters = {});
  static DistributerClass describe_class();

  const messages::MessageSet& message_set() const override;
  void peer_changed() override { hello_due_ = true; }
  void receive(messages::MessageRef message) override;
  void reach(Duration instant, messages::Receiver& system) override;
  void finish() override;
  /// A command at each instant, for silence is one, too: it is heard if CommandData came since the instant before.
  /// Gains when some came.
  bool take(std::size_t channel, void* value) override;
  void hand_over(std::size_t channel, const void* value, messages::Receiver& system) override;

 private:
  bool receive_gains(messages::MessageRef message);

  std::string trim_file_;
  Trim kept_, trim_;  // at the start, and in the newest report
  tasks::PilotCommand command_{.heard = false};
  tasks::OperatorGains gains_;
  bool gains_fresh_ = false;
  bool hello_due_ = false;

  Duration now_{}, taken_{}, period_{}, reported_{};
  std::array<double, 3> rates_{};  // of roll, pitch, yaw in the report before, mrad/s
  std::uint8_t state_;             // in the report before
  std::uint16_t reports_ = 0;
};

}  // namespace jarol::distributers
