// The JAviator's Robostix, the board between flight controller, motors and sensors.
#pragma once

#include <array>
#include <cstdint>

#include "distributers/messages/message.h"
#include "graph/values/archive.h"

namespace jarol::vehicles {

inline constexpr double max_signal = 16000.0;  // of a motor

/// Motors are locked until a SwitchState, and again after a ShutDown. Without MotorSignals for 100 ms the signals fall
/// by 5 each 100 ms. Each sonar's range is reported for 4 s after an EnSensors that asks for it.
class Robostix {
 public:
  /// Others than its own messages are ignored.
  void accept(messages::MessageRef command);

  /// 5 ms pass.
  void step();

  /// Those that the motors get, in the order front, right, rear, left; 0 to 16000.
  const std::array<double, 4>& signals() const { return signals_; }

  /// MotorSignals came in the step that has just passed, to be answered now.
  bool answers() const { return answers_; }
  std::uint16_t id() const { return id_; }
  bool reports_each_sonar() const { return sonar_steps_ > 0; }

  void serialize(Archive& archive) { archive(signals_, unlocked_, asked_, answers_, id_, silent_steps_, sonar_steps_); }

 private:
  std::array<double, 4> signals_{};
  bool unlocked_ = false;
  bool asked_ = false;
  bool answers_ = false;
  std::uint16_t id_ = 0;
  int silent_steps_ = 0;
  int sonar_steps_ = 0;  // for which each sonar is reported
};

}  // namespace jarol::vehicles
