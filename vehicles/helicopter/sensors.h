// The helicopter's sensors, each at its own rate, as the Robostix gathers them for JAVIATOR_DATA.
#pragma once

#include <array>
#include <cstdint>

#include "distributers/messages/javiator.h"
#include "vehicles/helicopter/body.h"
#include "vehicles/helicopter/parameters.h"
#include "vehicles/sensors/noise.h"

namespace jarol::vehicles {

/// Distance from a point in a room to its wall in a direction of NED; 0: none, or outside.
double cast_ray(const SensorParameters& room, const fossen::Vector3& from_n, const fossen::Vector3& direction_n);

class HelicopterSensors {
 public:
  HelicopterSensors(const HelicopterParameters& parameters, std::uint64_t seed);

  /// What there is to measure.
  struct Scene {
    HelicopterMotion motion;
    fossen::Vector3 specific_force{};
    double voltage = 0.0;
  };

  /// Sonars, lasers and pressure measure if their time has come.
  void sample(std::int64_t nanoseconds, const Scene& scene);

  /// The IMU measures: asked by the Robostix once it has sent an answer.
  void sample_imu(std::int64_t nanoseconds, const Scene& scene);

  /// The answer to motor signals; what was new is new no longer.
  messages::javiator::JaviatorData answer(std::uint16_t id);

  /// What each of four sonars reported last, for that answer.
  messages::javiator::SonarData each_sonar(std::uint16_t id) const;

  void serialize(Archive& archive);

 private:
  using Error = FailingSensor::Error;
  void sample_pressure(const Scene& scene, const Error& error);
  void sample_sonars(const Scene& scene, const Error& error);
  // reading of a laser at p_b that looks along an axis of the body
  std::array<std::uint8_t, 8> range_of(const Scene& scene, std::size_t axis, const fossen::Vector3& p_b,
                                       const Error& error);
  void wander(std::int64_t nanoseconds);

  SensorParameters parameters_;
  NoiseParameters deviations_;
  FailingSensor imu_, sonar_, laser_north_, laser_east_, bmu_;
  Noise imu_noise_, sonar_noise_;
  std::array<Noise, 2> laser_noise_;  // of the one that looks forward, of the one that looks right
  Noise bmu_noise_;
  Noise drift_noise_;
  fossen::Vector3 rate_bias_{}, force_bias_{};
  std::int64_t wandered_ = 0;  // ns
  messages::javiator::JaviatorData data_{};
  messages::javiator::SonarData each_sonar_{};
  std::int64_t sampled_ = -1;  // ns
  double ground_z_ = 0.0;      // height at which `pressure` holds
};

}  // namespace jarol::vehicles
