#include "vehicles/helicopter/robostix.h"

#include <algorithm>

#include "distributers/messages/javiator.h"

namespace jarol::vehicles {
namespace {

constexpr int watchdog_steps = 20;  // 100 ms
constexpr int asked_steps = 800;    // 4 s
constexpr double max = 16000.0;

}  // namespace

void Robostix::accept(messages::MessageRef command) {
  namespace javiator = messages::javiator;
  if (const auto* motors = command.as<javiator::MotorSignals>()) {
    asked_ = true;
    id_ = motors->id;
    silent_steps_ = 0;
    if (!unlocked_) return;
    const std::array<std::int16_t, 4> wanted = {motors->front, motors->right, motors->rear, motors->left};
    for (std::size_t i = 0; i < 4; ++i) signals_[i] = std::clamp(static_cast<double>(wanted[i]), 0.0, max);
  } else if (command.as<javiator::SwitchState>() != nullptr) {
    unlocked_ = true;
  } else if (command.as<javiator::ShutDown>() != nullptr) {
    unlocked_ = false;
    signals_ = {};
  } else if (const auto* sensors = command.as<javiator::EnSensors>()) {
    sonar_steps_ = (sensors->enable & javiator::EnSensors::Enable::EACH_SONAR) != 0 ? asked_steps : 0;
  }
}

void Robostix::step() {
  answers_ = asked_;
  asked_ = false;
  sonar_steps_ = std::max(sonar_steps_ - 1, 0);
  if (++silent_steps_ % watchdog_steps != 0) return;
  for (double& signal : signals_) signal = std::max(signal - 5.0, 0.0);
}

}  // namespace jarol::vehicles
