// The helicopter as the core sees it: what its sensors report comes in, motor signals go out.
#pragma once

#include "distributers/interfaces/distributer.h"
#include "distributers/messages/javiator.h"
#include "tasks/values/javiator.h"

namespace jarol::distributers {
namespace javiator = messages::javiator;

/// Speaks the JAviator's protocol: JaviatorData in; MotorSignals, SwitchState and ShutDown out. Answers come in the
/// order of the signals that they answer; one that was held up on its way is left out.
class JaviatorVehicle {
 public:
  static constexpr std::string_view summary = "the helicopter, over the JAviator's protocol";
  static constexpr bool is_vehicle = true;

  struct In {
    Newest<tasks::JaviatorSensors> sensors;
    static constexpr auto fields() { return describe(channel<&In::sensors>("what its sensors report")); }
  };
  struct Out {
    tasks::MotorCommand motors;
    static constexpr auto fields() { return describe(channel<&Out::motors>("signals for the four motors")); }
  };

  static const messages::MessageSet& message_set() { return javiator::message_set(); }
  static constexpr auto handlers() {
    return handle(on<javiator::JaviatorData>(&JaviatorVehicle::data),
                  send<&Out::motors>(&JaviatorVehicle::send_motors));
  }

  /// Who only hands over what is safe does not unlock motors; a ShutDown too many does no harm.
  void take_over() { unlocked_ = true; }
  void serialize(Archive& archive) { archive(unlocked_, id_, answered_, number_); }

  In in;

 private:
  void data(const javiator::JaviatorData& d);
  bool is_late(std::uint16_t id);
  std::uint32_t number_of(std::uint16_t id) const;
  void send_motors(const tasks::MotorCommand& motors, messages::Receiver& system);

  bool unlocked_ = false;
  std::uint16_t id_ = 0, answered_ = 0;  // of the signals sent last, and of the newest ones that were answered
  std::uint32_t number_ = 0;             // of the command sent last
};

}  // namespace jarol::distributers
