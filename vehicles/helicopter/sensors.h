// The helicopter's sensors, each at its own rate, as the Robostix gathers them for JAVIATOR_DATA.
#pragma once

#include <cstdint>

#include "distributers/messages/javiator.h"
#include "vehicles/helicopter/body.h"
#include "vehicles/helicopter/parameters.h"
#include "vehicles/sensors/noise.h"

namespace jarol::vehicles {

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

 private:
  void sample_pressure(const Scene& scene, double bias);
  void sample_sonars(const Scene& scene, double bias);
  // reading of a laser at p_b that looks along an axis of NED at a wall
  std::array<std::uint8_t, 8> range_of(const Scene& scene, std::size_t axis, double wall, const fossen::Vector3& p_b,
                                       double bias);

  SensorParameters parameters_;
  NoiseParameters deviations_;
  FailureParameters failures_;
  Noise imu_noise_, sonar_noise_, laser_noise_, bmu_noise_;
  fossen::Vector3 rate_bias_{}, force_bias_{};
  messages::javiator::JaviatorData data_{};
  std::int64_t sampled_ = -1;  // ns
  double ground_z_ = 0.0;      // height at which `pressure` holds
};

}  // namespace jarol::vehicles
