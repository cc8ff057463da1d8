#include "vehicles/helicopter/sensors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph/values/seed.h"

namespace jarol::vehicles {
namespace {

using messages::javiator::JaviatorData;

// samples a second, times two: 27.5 of them are a whole number
constexpr std::int64_t bmu_half_hertz = 55, sonar_half_hertz = 44, laser_half_hertz = 50;
constexpr double pascal_per_metre = 12.0;
constexpr double sonar_reach = 3.0;  // m

// has another sample of that rate fallen due since the last look?
bool due(std::int64_t before, std::int64_t now, std::int64_t half_hertz) {
  return before < 0 || before * half_hertz / 2'000'000'000 != now * half_hertz / 2'000'000'000;
}

// Lets a sensor measure with its bias, tell its last reading again, or say nothing.
template <class Measure>
void sample_with(const SensorFailure& failure, std::int64_t nanoseconds, std::int64_t bit, JaviatorData& data,
                 const Measure& measure) {
  const FailureKind kind = failure.now(1e-9 * static_cast<double>(nanoseconds));
  if (kind == FailureKind::lost) return;
  data.flags = static_cast<std::uint16_t>(data.flags | bit);
  if (kind != FailureKind::stuck) measure(kind == FailureKind::biased ? failure.by : 0.0);
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

fossen::Vector3 draw_bias(Noise& noise, double deviation) {
  return {deviation * noise.normal(), deviation * noise.normal(), deviation * noise.normal()};
}

}  // namespace

HelicopterSensors::HelicopterSensors(const HelicopterParameters& parameters, std::uint64_t seed)
    : parameters_(parameters.sensors),
      deviations_(parameters.noise),
      failures_(parameters.failures),
      imu_noise_(spread_seed(seed, "imu")),
      sonar_noise_(spread_seed(seed, "sonar")),
      laser_noise_(spread_seed(seed, "laser")),
      bmu_noise_(spread_seed(seed, "bmu")),
      rate_bias_(draw_bias(imu_noise_, deviations_.rate_bias)),
      force_bias_(draw_bias(imu_noise_, deviations_.force_bias)) {}

void HelicopterSensors::sample(std::int64_t nanoseconds, const Scene& scene) {
  if (sampled_ < 0) ground_z_ = scene.motion.p_n[2];
  const SensorParameters& p = parameters_;
  if (due(sampled_, nanoseconds, bmu_half_hertz))
    sample_with(failures_.bmu, nanoseconds, JaviatorData::Flags::BMU, data_,
                [&](double bias) { sample_pressure(scene, bias); });
  if (due(sampled_, nanoseconds, sonar_half_hertz))
    sample_with(failures_.sonar, nanoseconds, JaviatorData::Flags::SONAR, data_,
                [&](double bias) { sample_sonars(scene, bias); });
  if (due(sampled_, nanoseconds, laser_half_hertz)) {
    sample_with(failures_.laser_north, nanoseconds, JaviatorData::Flags::X_POS, data_, [&](double bias) {
      data_.x_pos = range_of(scene, 0, p.wall_north, {p.laser_north_x, p.laser_north_y, p.laser_north_z}, bias);
    });
    sample_with(failures_.laser_east, nanoseconds, JaviatorData::Flags::Y_POS, data_, [&](double bias) {
      data_.y_pos = range_of(scene, 1, p.wall_east, {p.laser_east_x, p.laser_east_y, p.laser_east_z}, bias);
    });
  }
  sampled_ = nanoseconds;
}

void HelicopterSensors::sample_pressure(const Scene& scene, double bias) {
  const double pascal = parameters_.pressure + pascal_per_metre * (scene.motion.p_n[2] - ground_z_) + bias +
                        deviations_.pressure * bmu_noise_.normal();
  const double voltage = scene.voltage + deviations_.voltage * bmu_noise_.normal();
  data_.maps = static_cast<std::uint32_t>(std::clamp(pascal * 1e3 * 0x1p24 / 115e6, 0.0, 0x1p24 - 1.0));
  data_.temp = to_counts((100.0 * parameters_.temperature + 700.0) * 4096.0 / 10000.0 + 0.5, 65535.0);
  data_.batt = to_counts(1e3 * voltage * 1024.0 / 18000.0, 1023.0);
}

void HelicopterSensors::sample_sonars(const Scene& scene, double bias) {
  const HelicopterMotion& m = scene.motion;
  std::array<double, 4> ranges{};
  fossen::Vector3 r_b = {parameters_.sonar_x, parameters_.sonar_y, parameters_.sonar_z};
  const std::size_t count = parameters_.sonars;
  for (std::size_t i = 0; i < count; ++i) {
    // along the body's z; looking up it sees nothing
    const double height = -(m.p_n[2] + fossen::dot(m.R_nb[2], r_b));
    ranges[i] = m.R_nb[2][2] > 0.1 ? height / m.R_nb[2][2] : sonar_reach;
    ranges[i] += bias + deviations_.sonar * sonar_noise_.normal();
    if (sonar_noise_.uniform() < deviations_.sonar_outliers) ranges[i] = sonar_reach * sonar_noise_.uniform();
    r_b = {-r_b[1], r_b[0], r_b[2]};  // the next one is a quarter of a turn on
  }
  std::sort(ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(count));
  const double range = count == 4 ? 0.5 * (ranges[1] + ranges[2]) : ranges[0];
  data_.sonar = to_counts(range / sonar_reach * 1024.0, 1023.0);
}

// as the flight controller takes them: position is the laser's place, turned to NED, less the range, from a wall on
std::array<std::uint8_t, 8> HelicopterSensors::range_of(const Scene& scene, std::size_t axis, double wall,
                                                        const fossen::Vector3& p_b, double bias) {
  const double place = scene.motion.p_n[axis] - to_ned(scene.motion.R_nb, p_b)[axis];
  return to_digits(wall - place + bias + deviations_.laser * laser_noise_.normal());
}

void HelicopterSensors::sample_imu(std::int64_t nanoseconds, const Scene& scene) {
  sample_with(failures_.imu, nanoseconds, JaviatorData::Flags::IMU, data_, [&](double bias) {
    const HelicopterMotion& m = scene.motion;
    const auto angle = [&](double value) { return to_angle(value + deviations_.attitude * imu_noise_.normal()); };
    data_.roll = angle(std::atan2(m.R_nb[2][1], m.R_nb[2][2]) + bias);
    data_.pitch = angle(-std::asin(std::clamp(m.R_nb[2][0], -1.0, 1.0)));
    data_.yaw = angle(std::atan2(m.R_nb[1][0], m.R_nb[0][0]));
    const auto rate = [&](std::size_t i) {
      const double value = m.omega_b[i] + rate_bias_[i] + deviations_.rate * imu_noise_.normal();
      return to_int16(value * 1e3 * 32768.0 / 8500.0);
    };
    const auto force = [&](std::size_t i) {
      const double value = scene.specific_force[i] + force_bias_[i] + deviations_.force * imu_noise_.normal();
      return to_int16(value * 1e3 * 4681.0 / 9810.0);
    };
    data_.droll = rate(0);
    data_.dpitch = rate(1);
    data_.dyaw = rate(2);
    data_.ddx = force(0);
    data_.ddy = force(1);
    data_.ddz = force(2);
  });
}

JaviatorData HelicopterSensors::answer(std::uint16_t id) {
  data_.id = id;
  const JaviatorData answer = data_;
  data_.flags = 0;
  return answer;
}

}  // namespace jarol::vehicles
