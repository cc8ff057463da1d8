#include "vehicles/helicopter/sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "graph/math/euler_angles.h"
#include "graph/math/geometry.h"
#include "graph/values/seed.h"
#include "vehicles/helicopter/coefficients.h"

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

// Lets a sensor measure with its error, report its last reading again, or say nothing.
template <class Measure>
void sample_with(FailingSensor& failing, std::int64_t nanoseconds, std::int64_t bit, JaviatorData& data,
                 const Measure& measure) {
  const double seconds = 1e-9 * static_cast<double>(nanoseconds);
  const FailureKind kind = failing.now(seconds);
  if (kind == FailureKind::lost) return;
  data.flags = static_cast<std::uint16_t>(data.flags | bit);
  if (kind != FailureKind::stuck) measure(failing.error(seconds));
}

std::int16_t to_int16(double value) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -32768.0, 32767.0)));
}

std::uint16_t to_counts(double value, double limit) {
  return static_cast<std::uint16_t>(std::clamp(std::floor(value), 0.0, limit));
}

// an angle's 16 bits go all the way round
std::int16_t to_angle(double radians) {
  const auto counts = std::lround(wrapped(radians) * 65536.0 / (2.0 * std::numbers::pi));
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

// along one axis: to the wall ahead, beyond all if there is none
double way_to_wall(double place, double direction, double ahead, double behind) {
  if (direction == 0.0) return std::numeric_limits<double>::infinity();
  return ((direction > 0.0 ? ahead : -behind) - place) / direction;
}

}  // namespace

double cast_ray(const SensorParameters& room, const fossen::Vector3& from_n, const fossen::Vector3& direction_n) {
  const bool outside = from_n[0] > room.wall_north || from_n[0] < -room.wall_south || from_n[1] > room.wall_east ||
                       from_n[1] < -room.wall_west;
  const double range = std::min(way_to_wall(from_n[0], direction_n[0], room.wall_north, room.wall_south),
                                way_to_wall(from_n[1], direction_n[1], room.wall_east, room.wall_west));
  return outside || range > room.laser_reach ? 0.0 : range;
}

HelicopterSensors::HelicopterSensors(const HelicopterParameters& parameters, std::uint64_t seed)
    : parameters_(parameters.sensors),
      deviations_(parameters.noise),
      imu_(parameters.failures.imu, spread_seed(seed, "imu.failure")),
      sonar_(parameters.failures.sonar, spread_seed(seed, "sonar.failure")),
      laser_north_(parameters.failures.laser_north, spread_seed(seed, "laser_north.failure")),
      laser_east_(parameters.failures.laser_east, spread_seed(seed, "laser_east.failure")),
      bmu_(parameters.failures.bmu, spread_seed(seed, "bmu.failure")),
      imu_noise_(spread_seed(seed, "imu")),
      sonar_noise_(spread_seed(seed, "sonar")),
      laser_noise_{Noise(spread_seed(seed, "laser_north")), Noise(spread_seed(seed, "laser_east"))},
      bmu_noise_(spread_seed(seed, "bmu")),
      drift_noise_(spread_seed(seed, "drift")),
      rate_bias_(draw_bias(imu_noise_, deviations_.rate_bias)),
      force_bias_(draw_bias(imu_noise_, deviations_.force_bias)),
      ground_z_(make_start(parameters).p_n[2]) {}

void HelicopterSensors::serialize(Archive& archive) {
  archive(imu_noise_, sonar_noise_, laser_noise_, bmu_noise_, drift_noise_, imu_, sonar_, laser_north_, laser_east_,
          bmu_, rate_bias_, force_bias_, sampled_, wandered_);
  archive.bytes(&data_, sizeof data_);
  archive.bytes(&each_sonar_, sizeof each_sonar_);
}

void HelicopterSensors::sample(std::int64_t nanoseconds, const Scene& scene) {
  const SensorParameters& p = parameters_;
  if (due(sampled_, nanoseconds, bmu_half_hertz))
    sample_with(bmu_, nanoseconds, JaviatorData::Flags::BMU, data_,
                [&](const Error& error) { sample_pressure(scene, error); });
  if (due(sampled_, nanoseconds, sonar_half_hertz))
    sample_with(sonar_, nanoseconds, JaviatorData::Flags::SONAR, data_,
                [&](const Error& error) { sample_sonars(scene, error); });
  if (due(sampled_, nanoseconds, laser_half_hertz)) {
    sample_with(laser_north_, nanoseconds, JaviatorData::Flags::X_POS, data_, [&](const Error& error) {
      data_.x_pos = range_of(scene, 0, {p.laser_north_x, p.laser_north_y, p.laser_north_z}, error);
    });
    sample_with(laser_east_, nanoseconds, JaviatorData::Flags::Y_POS, data_, [&](const Error& error) {
      data_.y_pos = range_of(scene, 1, {p.laser_east_x, p.laser_east_y, p.laser_east_z}, error);
    });
  }
  sampled_ = nanoseconds;
}

void HelicopterSensors::sample_pressure(const Scene& scene, const Error& error) {
  const double pascal = parameters_.pressure + pascal_per_metre * (scene.motion.p_n[2] - ground_z_) + error.bias +
                        error.noise * deviations_.pressure * bmu_noise_.normal();
  const double voltage = scene.voltage + error.noise * deviations_.voltage * bmu_noise_.normal();
  data_.maps = static_cast<std::uint32_t>(std::clamp(pascal * 1e3 * 0x1p24 / 115e6, 0.0, 0x1p24 - 1.0));
  data_.temp = to_counts((100.0 * parameters_.temperature + 700.0) * 4096.0 / 10000.0 + 0.5, 65535.0);
  data_.batt = to_counts(1e3 * voltage * 1024.0 / 18000.0, 1023.0);
}

void HelicopterSensors::sample_sonars(const Scene& scene, const Error& error) {
  const HelicopterMotion& m = scene.motion;
  std::array<double, 4> ranges{};
  fossen::Vector3 r_b = {parameters_.sonar_x, parameters_.sonar_y, parameters_.sonar_z};
  const std::size_t count = parameters_.sonars;
  for (std::size_t i = 0; i < count; ++i) {
    // along the body's z; looking up it sees nothing
    const double height = -(m.p_n[2] + fossen::dot(m.R_nb[2], r_b));
    ranges[i] = m.R_nb[2][2] > 0.1 ? height / m.R_nb[2][2] : sonar_reach;
    ranges[i] += error.bias + error.noise * deviations_.sonar * sonar_noise_.normal();
    if (sonar_noise_.uniform() < error.noise * deviations_.sonar_outliers)
      ranges[i] = sonar_reach * sonar_noise_.uniform();
    r_b = {-r_b[1], r_b[0], r_b[2]};  // the next one is a quarter of a turn on
  }
  const auto counts = [](double range) { return to_counts(range / sonar_reach * 1024.0, 1023.0); };
  each_sonar_ = {counts(ranges[0]), counts(ranges[1]), counts(ranges[2]), counts(ranges[3]), 0};
  std::sort(ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(count));
  const double range = count == 4 ? 0.5 * (ranges[1] + ranges[2]) : ranges[0];
  data_.sonar = counts(range);
}

std::array<std::uint8_t, 8> HelicopterSensors::range_of(const Scene& scene, std::size_t axis,
                                                        const fossen::Vector3& p_b, const Error& error) {
  const HelicopterMotion& m = scene.motion;
  const fossen::Vector3 lever_n = to_ned(m.R_nb, p_b);
  fossen::Vector3 along_b{};
  along_b[axis] = 1.0;
  const double range = cast_ray(parameters_, {m.p_n[0] + lever_n[0], m.p_n[1] + lever_n[1], m.p_n[2] + lever_n[2]},
                                to_ned(m.R_nb, along_b));
  const double noise = error.noise * deviations_.laser * laser_noise_[axis].normal();
  return to_digits(range > 0.0 ? range + error.bias + noise : 0.0);
}

// biases walk at random, each at its own pace
void HelicopterSensors::wander(std::int64_t nanoseconds) {
  const double steps = std::sqrt(1e-9 * static_cast<double>(nanoseconds - wandered_) / 100.0);
  wandered_ = nanoseconds;
  const auto walk = [&](fossen::Vector3& biases, double drift) {
    if (drift == 0.0) return;
    for (double& bias : biases) bias += drift * steps * drift_noise_.normal();
  };
  walk(rate_bias_, deviations_.rate_drift);
  walk(force_bias_, deviations_.force_drift);
}

void HelicopterSensors::sample_imu(std::int64_t nanoseconds, const Scene& scene) {
  wander(nanoseconds);
  sample_with(imu_, nanoseconds, JaviatorData::Flags::IMU, data_, [&](const Error& error) {
    const HelicopterMotion& m = scene.motion;
    const auto noisy = [&](double deviation) { return error.noise * deviation * imu_noise_.normal(); };
    const auto angle = [&](double value) { return to_angle(value + noisy(deviations_.attitude)); };
    const EulerAngles attitude = euler_angles_of(m.R_nb);
    data_.roll = angle(attitude.roll + error.bias);
    data_.pitch = angle(attitude.pitch);
    data_.yaw = angle(attitude.yaw);
    const auto rate = [&](std::size_t i) {
      const double value = m.omega_b[i] + rate_bias_[i] + noisy(deviations_.rate);
      return to_int16(value * 1e3 * 32768.0 / 8500.0);
    };
    const auto force = [&](std::size_t i) {
      const double value = scene.specific_force[i] + force_bias_[i] + noisy(deviations_.force);
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

messages::javiator::SonarData HelicopterSensors::each_sonar(std::uint16_t id) const {
  messages::javiator::SonarData ranges = each_sonar_;
  ranges.id = id;
  return ranges;
}

}  // namespace jarol::vehicles
