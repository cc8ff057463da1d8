// The helicopter as the core sees it: what its sensors report comes in, motor signals go out.
#pragma once

#include "distributers/interfaces/distributer.h"
#include "distributers/messages/javiator.h"
#include "tasks/values/javiator.h"

namespace jarol::distributers {
namespace javiator = messages::javiator;

struct JaviatorVehicleParameters {
  bool each_sonar = false;

  static constexpr auto fields() {
    return describe(field<&JaviatorVehicleParameters::each_sonar>(
        "", "ask for the range of each sonar (EN_SENSORS), which the JAviator's own Robostix does not report"));
  }
};

/// The newest of the motor signals, by their numbers, that were answered.
struct NewestAnswer {
  /// Whether no newer signals were answered before; `answered` is the newest now, if so. `sent`: signals sent last;
  /// an answer to others than were sent says nothing about the order.
  bool accept(std::uint16_t answered, std::uint16_t sent);
  /// After each signals sent: numbers wrap around, and what was answered long ago is not newer than what comes.
  void keep_up(std::uint16_t sent);

  std::uint16_t id = 0;
};

/// Speaks the JAviator's protocol: JaviatorData in; MotorSignals, SwitchState and ShutDown out. Answers come in the
/// order of the signals that they answer; one that was held up on its way is left out. Beyond the JAviator's protocol
/// it may ask for each sonar's range: EnSensors out, SonarData in.
class JaviatorVehicle {
 public:
  static constexpr std::string_view summary = "the helicopter, over the JAviator's protocol";
  static constexpr bool is_vehicle = true;
  using Param = JaviatorVehicleParameters;

  struct In {
    Newest<tasks::JaviatorSensors> sensors;
    Newest<tasks::SonarRanges> sonars;
    static constexpr auto fields() {
      return describe(channel<&In::sensors>("what its sensors report"),
                      channel<&In::sonars>("what each of its sonars reports, if it was asked for"));
    }
  };
  struct Out {
    tasks::MotorCommand motors;
    static constexpr auto fields() { return describe(channel<&Out::motors>("signals for the four motors")); }
  };

  static const messages::MessageSet& message_set() { return javiator::message_set(); }
  static constexpr auto handlers() {
    return handle(on<javiator::JaviatorData>(&JaviatorVehicle::data),
                  on<javiator::SonarData>(&JaviatorVehicle::sonar_data),
                  send<&Out::motors>(&JaviatorVehicle::send_motors));
  }

  explicit JaviatorVehicle(const JaviatorVehicleParameters& parameters = {}) : parameters_(parameters) {}

  /// Who only hands over what is safe does not unlock motors; a ShutDown too many does no harm.
  void take_over() { unlocked_ = true; }
  void serialize(Archive& archive) { archive(unlocked_, id_, answered_.id, ranged_.id, number_); }

  In in;

 private:
  void data(const javiator::JaviatorData& d);
  void sonar_data(const javiator::SonarData& d);
  std::uint32_t number_of(std::uint16_t id) const;
  void send_motors(const tasks::MotorCommand& motors, messages::Receiver& system);

  JaviatorVehicleParameters parameters_;
  bool unlocked_ = false;
  std::uint16_t id_ = 0;            // of the signals sent last
  NewestAnswer answered_, ranged_;  // by JaviatorData, and by SonarData
  std::uint32_t number_ = 0;        // of the command sent last
};

}  // namespace jarol::distributers
