#include "distributers/javiator/vehicle.h"

#include <algorithm>
#include <cmath>

#include "distributers/messages/javiator_units.h"

namespace jarol::distributers {
namespace {

constexpr std::uint16_t repeat_every = 64;     // signals: about a second
constexpr std::uint16_t longest_delay = 1000;  // of an answer, in signals sent since

std::int16_t to_signal(double signal) {
  return static_cast<std::int16_t>(std::clamp(std::trunc(signal), 0.0, 16000.0));
}

}  // namespace

// Signals of another controller, or of a run before, say nothing about the order.
bool NewestAnswer::accept(std::uint16_t answered, std::uint16_t sent) {
  const auto is_after = [](std::uint16_t a, std::uint16_t b) { return static_cast<std::int16_t>(a - b) > 0; };
  if (is_after(answered, sent)) return true;
  if (is_after(id, answered)) return false;
  id = answered;
  return true;
}

void NewestAnswer::keep_up(std::uint16_t sent) {
  if (static_cast<std::uint16_t>(sent - id) > longest_delay) id = sent - longest_delay;
}

// Commands are numbered one by one, as signals are, but for those that a fault has held.
std::uint32_t JaviatorVehicle::number_of(std::uint16_t id) const {
  const std::uint16_t since = id_ - id;
  return number_ > since && since <= longest_delay ? number_ - since : 0;
}

void JaviatorVehicle::data(const javiator::JaviatorData& d) {
  if (!answered_.accept(d.id, id_)) return;
  const bool waits = in.sensors.is_new;
  tasks::JaviatorSensors& s = in.sensors.renew();
  const auto has = [&](std::uint16_t bit) { return (d.flags & bit) != 0; };
  // what was new and has not been taken yet is new still
  const auto is_new = [&](bool before, std::uint16_t bit) { return (waits && before) || has(bit); };
  s = {.roll = javiator::radians_per_count * d.roll,
       .pitch = javiator::radians_per_count * d.pitch,
       .yaw = javiator::radians_per_count * d.yaw,
       .p = javiator::radians_per_second_per_count * d.droll,
       .q = javiator::radians_per_second_per_count * d.dpitch,
       .r = javiator::radians_per_second_per_count * d.dyaw,
       .a_x = javiator::newtons_per_kilogram_per_count * d.ddx,
       .a_y = javiator::newtons_per_kilogram_per_count * d.ddy,
       .a_z = javiator::newtons_per_kilogram_per_count * d.ddz,
       .sonar = javiator::sonar_metres_per_count * d.sonar,
       .laser_x = javiator::metres_of(d.x_pos),
       .laser_y = javiator::metres_of(d.y_pos),
       .pressure = javiator::pascals_per_count * d.maps,
       .temperature = javiator::celsius_of(d.temp),
       .battery = javiator::volts_per_count * d.batt,
       .new_imu = is_new(s.new_imu, javiator::JaviatorData::Flags::IMU),
       .new_bmu = is_new(s.new_bmu, javiator::JaviatorData::Flags::BMU),
       .new_sonar = is_new(s.new_sonar, javiator::JaviatorData::Flags::SONAR),
       .new_x = is_new(s.new_x, javiator::JaviatorData::Flags::X_POS),
       .new_y = is_new(s.new_y, javiator::JaviatorData::Flags::Y_POS),
       .answers = s.answers + 1,
       .answered = number_of(d.id)};
}

void JaviatorVehicle::sonar_data(const javiator::SonarData& d) {
  const bool is_doubled = in.sonars->readings > 0 && d.id == ranged_.id;
  if (is_doubled || !ranged_.accept(d.id, id_)) return;
  const auto metres = [](std::uint16_t counts) { return javiator::sonar_metres_per_count * counts; };
  in.sonars = {.ranges = {metres(d.front), metres(d.right), metres(d.rear), metres(d.left)},
               .readings = in.sonars->readings + 1};
}

void JaviatorVehicle::send_motors(const tasks::MotorCommand& motors, messages::Receiver& system) {
  // more than once: the link may lose it, and a Robostix that was started anew is locked
  const bool repeats = (id_ + 1) % repeat_every == 0;
  if (parameters_.each_sonar && (id_ == 0 || repeats))
    system.receive(messages::refer_to(javiator::EnSensors{javiator::EnSensors::Enable::EACH_SONAR}));
  if (motors.unlocked && (!unlocked_ || repeats)) system.receive(messages::refer_to(javiator::SwitchState{}));
  if (!motors.unlocked && (unlocked_ || repeats)) system.receive(messages::refer_to(javiator::ShutDown{}));
  unlocked_ = motors.unlocked;
  ++id_;
  number_ = motors.number;
  answered_.keep_up(id_);
  ranged_.keep_up(id_);
  const auto& s = motors.signals;
  system.receive(messages::refer_to(
      javiator::MotorSignals{to_signal(s[0]), to_signal(s[1]), to_signal(s[2]), to_signal(s[3]), id_}));
}

}  // namespace jarol::distributers
