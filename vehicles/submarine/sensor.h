// One sensor: measures at its rate with its errors, reports after its delay, fails on schedule.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vehicles/sensors/noise.h"
#include "vehicles/submarine/sensor_parameters.h"

namespace jarol::vehicles {

class Sensor {
 public:
  using Values = std::array<double, 3>;  // what is not used is 0

  /// Throws InputError unless period and delay are multiples of the vehicle's step of 10 ms.
  template <class Kind>
  Sensor(const SensorOf<Kind>& parameters, const std::string& name, std::uint64_t seed, std::size_t width = 1)
      : Sensor({parameters.noise, parameters.bias, parameters.drift, parameters.resolution, parameters.failure},
               parameters.period, parameters.delay, name, seed, width) {}

  /// At a step of the vehicle, each once; without truth there is nothing to measure.
  void step(std::int64_t step, const std::optional<Values>& truth);

  /// A reading came at this step.
  bool reported() const { return reported_; }
  /// The newest reading, NaN before the first.
  const Values& values() const { return values_; }
  double value() const { return values_[0]; }

  void serialize(Archive& archive);

 private:
  struct Errors {
    double noise = 0.0, bias = 0.0, drift = 0.0, resolution = 0.0;
    SensorFailure failure;
  };
  struct Reading {
    std::int64_t step = 0;
    Values values{};
    void serialize(Archive& archive) { archive(step, values); }
  };

  Sensor(const Errors& errors, Duration period, Duration delay, const std::string& name, std::uint64_t seed,
         std::size_t width);
  void measure(const Values& truth, const FailingSensor::Error& error);
  void wander(std::int64_t step);

  Errors errors_;
  std::int64_t period_ = 1, delay_ = 0;  // steps
  std::size_t width_ = 1;
  Noise noise_;
  Noise drift_noise_;
  Values wandered_{};             // of the bias, so far
  std::int64_t wandered_to_ = 0;  // step
  FailingSensor failing_;
  std::optional<Values> measured_;
  std::vector<Reading> pending_;  // a ring: those not reported yet
  std::size_t first_ = 0, count_ = 0;
  bool reported_ = false;
  Values values_;
};

}  // namespace jarol::vehicles
