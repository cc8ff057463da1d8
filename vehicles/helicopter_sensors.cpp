#include "vehicles/helicopter_sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace jarol::vehicles {
namespace {

using messages::javiator::JaviatorData;

// samples a second, times two: 27.5 of them are a whole number
constexpr std::int64_t bmu_half_hertz = 55, sonar_half_hertz = 44, laser_half_hertz = 50;
constexpr double pascal_per_metre = 12.0;

// has another sample of that rate fallen due since the last look?
bool due(std::int64_t before, std::int64_t now, std::int64_t half_hertz) {
  return before < 0 || before * half_hertz / 2'000'000'000 != now * half_hertz / 2'000'000'000;
}

std::int16_t to_int16(double value) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -32768.0, 32767.0)));
}

std::uint16_t to_counts(double value, double most) {
  return static_cast<std::uint16_t>(std::clamp(std::floor(value), 0.0, most));
}

// an angle's 16 bits go all the way round
std::int16_t to_angle(double radians) {
  const auto counts = std::lround(std::remainder(radians, 2.0 * std::numbers::pi) * 65536.0 / (2.0 * std::numbers::pi));
  return static_cast<std::int16_t>(std::clamp(counts, -32768L, 32767L));
}

std::array<std::uint8_t, 8> to_digits(double metres) {
  auto millimetres = std::lround(1e3 * std::clamp(metres, 0.0, 500.0));
  std::array<std::uint8_t, 8> digits{};
  for (std::size_t i = 7; i-- > 0; millimetres /= 10) digits[i] = static_cast<std::uint8_t>('0' + millimetres % 10);
  return digits;
}

}  // namespace

void HelicopterSensors::sample(std::int64_t nanoseconds, const Scene& scene) {
  if (sampled_ < 0) ground_z_ = scene.motion.p_n[2];
  if (due(sampled_, nanoseconds, bmu_half_hertz)) sample_pressure(scene);
  if (due(sampled_, nanoseconds, sonar_half_hertz)) sample_sonar(scene);
  if (due(sampled_, nanoseconds, laser_half_hertz)) sample_lasers(scene);
  sampled_ = nanoseconds;
}

void HelicopterSensors::sample_pressure(const Scene& scene) {
  const double pascal = parameters_.pressure + pascal_per_metre * (scene.motion.p_n[2] - ground_z_);
  data_.maps = static_cast<std::uint32_t>(std::clamp(pascal * 1e3 * 0x1p24 / 115e6, 0.0, 0x1p24 - 1.0));
  data_.temp = to_counts((100.0 * parameters_.temperature + 700.0) * 4096.0 / 10000.0 + 0.5, 65535.0);
  data_.batt = to_counts(1e3 * scene.voltage * 1024.0 / 18000.0, 1023.0);
  data_.state |= JaviatorData::new_bmu;
}

void HelicopterSensors::sample_sonar(const Scene& scene) {
  // along the body's z; looking up it sees nothing
  const HelicopterMotion& m = scene.motion;
  const fossen::Vector3 r_b = {parameters_.sonar_x, parameters_.sonar_y, parameters_.sonar_z};
  const double height = -(m.p_n[2] + fossen::dot(m.R_nb[2], r_b));
  const double range = m.R_nb[2][2] > 0.1 ? height / m.R_nb[2][2] : std::numeric_limits<double>::max();
  data_.sonar = to_counts(1e3 * range * 1024.0 / 3000.0, 1023.0);
  data_.state |= JaviatorData::new_sonar;
}

// as the flight controller takes them: position is the laser's place, turned to NED, less the range, from a wall on
void HelicopterSensors::sample_lasers(const Scene& scene) {
  const HelicopterMotion& m = scene.motion;
  const SensorParameters& p = parameters_;
  const fossen::Vector3 north = to_ned(m.R_nb, {p.laser_north_x, p.laser_north_y, p.laser_north_z});
  const fossen::Vector3 east = to_ned(m.R_nb, {p.laser_east_x, p.laser_east_y, p.laser_east_z});
  data_.x_pos = to_digits(p.wall_north - m.p_n[0] + north[0]);
  data_.y_pos = to_digits(p.wall_east - m.p_n[1] + east[1]);
  data_.state |= JaviatorData::new_x | JaviatorData::new_y;
}

void HelicopterSensors::sample_imu(const Scene& scene) {
  const HelicopterMotion& m = scene.motion;
  data_.roll = to_angle(std::atan2(m.R_nb[2][1], m.R_nb[2][2]));
  data_.pitch = to_angle(-std::asin(std::clamp(m.R_nb[2][0], -1.0, 1.0)));
  data_.yaw = to_angle(std::atan2(m.R_nb[1][0], m.R_nb[0][0]));
  const double rate = 1e3 * 32768.0 / 8500.0, force = 1e3 * 4681.0 / 9810.0;
  data_.droll = to_int16(rate * m.omega_b[0]);
  data_.dpitch = to_int16(rate * m.omega_b[1]);
  data_.dyaw = to_int16(rate * m.omega_b[2]);
  data_.ddx = to_int16(force * scene.specific_force[0]);
  data_.ddy = to_int16(force * scene.specific_force[1]);
  data_.ddz = to_int16(force * scene.specific_force[2]);
  data_.state |= JaviatorData::new_imu;
}

JaviatorData HelicopterSensors::answer(std::uint16_t id) {
  data_.id = id;
  const JaviatorData answer = data_;
  data_.state = 0;
  return answer;
}

}  // namespace jarol::vehicles
