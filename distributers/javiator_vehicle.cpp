#include "distributers/javiator_vehicle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "distributers/messages/javiator.h"

namespace jarol::distributers {
namespace javiator = messages::javiator;
namespace {

constexpr double angle = 2 * std::numbers::pi / 65536;
constexpr double rate = 8.5 / 32768;
constexpr double force = 9.81 / 4681;

double metres(const std::array<std::uint8_t, 8>& digits) {
  double millimetres = 0;
  for (const std::uint8_t digit : digits) {
    if (digit < '0' || digit > '9') break;
    millimetres = 10 * millimetres + (digit - '0');
  }
  return 1e-3 * millimetres;
}

std::int16_t to_signal(double signal) {
  return static_cast<std::int16_t>(std::clamp(std::trunc(signal), 0.0, 16000.0));
}

}  // namespace

DistributerClass JaviatorVehicle::describe_class() {
  return {"JaviatorVehicle",
          "the helicopter, over the JAviator's protocol",
          {{"sensors", Direction::in, &type_of<tasks::JaviatorSensors>(), "what its sensors tell"},
           {"motors", Direction::out, &type_of<tasks::MotorCommand>(), "signals for the four motors"}},
          true};
}

const messages::MessageSet& JaviatorVehicle::message_set() const { return javiator::message_set(); }

void JaviatorVehicle::receive(messages::MessageRef message) {
  const auto* d = message.as<javiator::JaviatorData>();
  if (d == nullptr) return;
  tasks::JaviatorSensors& s = sensors_;
  const auto has = [&](std::uint16_t bit) { return (d->flags & bit) != 0; };
  // what was new and has not been taken yet is new still
  const auto is_new = [&](bool before, std::uint16_t bit) { return (fresh_ && before) || has(bit); };
  s = {.roll = angle * d->roll,
       .pitch = angle * d->pitch,
       .yaw = angle * d->yaw,
       .p = rate * d->droll,
       .q = rate * d->dpitch,
       .r = rate * d->dyaw,
       .a_x = force * d->ddx,
       .a_y = force * d->ddy,
       .a_z = force * d->ddz,
       .sonar = 3.0 / 1024 * d->sonar,
       .laser_x = metres(d->x_pos),
       .laser_y = metres(d->y_pos),
       .pressure = 115e3 / 16777216 * d->maps,
       .temperature = 100.0 / 4096 * d->temp - 7,
       .battery = 18.0 / 1024 * d->batt,
       .new_imu = is_new(s.new_imu, javiator::JaviatorData::Flags::IMU),
       .new_bmu = is_new(s.new_bmu, javiator::JaviatorData::Flags::BMU),
       .new_sonar = is_new(s.new_sonar, javiator::JaviatorData::Flags::SONAR),
       .new_x = is_new(s.new_x, javiator::JaviatorData::Flags::X_POS),
       .new_y = is_new(s.new_y, javiator::JaviatorData::Flags::Y_POS),
       .answers = s.answers + 1};
  fresh_ = true;
}

bool JaviatorVehicle::take(std::size_t, void* value) {
  if (!fresh_) return false;
  *static_cast<tasks::JaviatorSensors*>(value) = sensors_;
  fresh_ = false;
  return true;
}

void JaviatorVehicle::hand_over(std::size_t, const void* value, messages::Receiver& system) {
  const auto& motors = *static_cast<const tasks::MotorCommand*>(value);
  if (motors.unlocked && !unlocked_) system.receive(messages::refer_to(javiator::SwitchState{}));
  if (!motors.unlocked && unlocked_) system.receive(messages::refer_to(javiator::ShutDown{}));
  unlocked_ = motors.unlocked;
  const auto& s = motors.signals;
  system.receive(messages::refer_to(
      javiator::MotorSignals{to_signal(s[0]), to_signal(s[1]), to_signal(s[2]), to_signal(s[3]), ++id_}));
}

}  // namespace jarol::distributers
