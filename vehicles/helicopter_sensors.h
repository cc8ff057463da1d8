// The helicopter's sensors, each at its own rate, as the Robostix gathers them for JAVIATOR_DATA.
#pragma once

#include <cstdint>

#include "distributers/messages/javiator.h"
#include "vehicles/helicopter_body.h"
#include "vehicles/helicopter_parameters.h"

namespace jarol::vehicles {

class HelicopterSensors {
 public:
  explicit HelicopterSensors(const SensorParameters& parameters) : parameters_(parameters) {}

  /// What there is to measure.
  struct Scene {
    HelicopterMotion motion;
    fossen::Vector3 specific_force{};
    double voltage = 0.0;
  };

  /// Sonar, lasers and pressure measure if their time has come.
  void sample(std::int64_t nanoseconds, const Scene& scene);

  /// The IMU measures: asked by the Robostix once it has sent an answer.
  void sample_imu(const Scene& scene);

  /// The answer to motor signals; what was new is new no longer.
  messages::javiator::JaviatorData answer(std::uint16_t id);

 private:
  void sample_pressure(const Scene& scene);
  void sample_sonar(const Scene& scene);
  void sample_lasers(const Scene& scene);

  SensorParameters parameters_;
  messages::javiator::JaviatorData data_{};
  std::int64_t sampled_ = -1;  // ns
  double ground_z_ = 0.0;      // height at which `pressure` holds
};

}  // namespace jarol::vehicles
