// Parameters of the submarine's sensors. By default each measures exactly, at its rate.
#pragma once

#include <string_view>

#include "graph/values/type_of.h"
#include "vehicles/sensors/sensor_failure.h"

namespace jarol::vehicles {

/// How a sensor of one kind measures: reading = truth + bias + noise, to the nearest multiple of the resolution. The
/// bias may drift: a random walk from what it is at first, whose standard deviation grows with the root of time.
template <class Kind>
struct SensorOf {
  double noise = 0.0;
  double bias = 0.0;
  double drift = 0.0;
  double resolution = 0.0;
  Duration period = std::chrono::milliseconds(Kind::milliseconds);
  Duration delay{};
  SensorFailure failure{};

  static constexpr auto fields() {
    using S = SensorOf;
    return describe(field<&S::noise>(Kind::unit, "standard deviation of each reading"),
                    field<&S::bias>(Kind::unit, "added to each reading"),
                    field<&S::drift>(Kind::unit, "standard deviation by which that has wandered after 100 s"),
                    field<&S::resolution>(Kind::unit, "readings are multiples of this; 0 for any"),
                    field<&S::period>("", "between readings"), field<&S::delay>("", "from measuring to telling"),
                    field<&S::failure>("", "when and how it fails"));
  }
};

// kinds: unit, and time between readings as on the vehicle
struct DepthSensor {
  static constexpr std::string_view unit = "m";
  static constexpr int milliseconds = 100;
};
struct PressureSensor {
  static constexpr std::string_view unit = "hPa";
  static constexpr int milliseconds = 100;
};
struct ConductivitySensor {
  static constexpr std::string_view unit = "S/m";
  static constexpr int milliseconds = 160;
};
struct TemperatureSensor {
  static constexpr std::string_view unit = "degC";
  static constexpr int milliseconds = 160;
};
struct AttitudeSensor {
  static constexpr std::string_view unit = "rad";
  static constexpr int milliseconds = 10;
};
struct RateSensor {
  static constexpr std::string_view unit = "rad/s";
  static constexpr int milliseconds = 10;
};
struct ForceSensor {
  static constexpr std::string_view unit = "m/s^2";
  static constexpr int milliseconds = 10;
};
struct CompassSensor {
  static constexpr std::string_view unit = "rad";
  static constexpr int milliseconds = 100;
};
struct SpeedSensor {
  static constexpr std::string_view unit = "m/s";
  static constexpr int milliseconds = 100;
};
struct RpmSensor {
  static constexpr std::string_view unit = "rpm";
  static constexpr int milliseconds = 50;
};
struct PositionSensor {
  static constexpr std::string_view unit = "m";
  static constexpr int milliseconds = 1000;
};
struct RangeSensor {
  static constexpr std::string_view unit = "m";
  static constexpr int milliseconds = 2000;
};
struct AltitudeSensor {
  static constexpr std::string_view unit = "m";
  static constexpr int milliseconds = 100;
};
struct LeakSensor {
  static constexpr std::string_view unit = "";
  static constexpr int milliseconds = 1000;
};
struct SlowTemperatureSensor {
  static constexpr std::string_view unit = "degC";
  static constexpr int milliseconds = 1000;
};
struct VoltageSensor {
  static constexpr std::string_view unit = "V";
  static constexpr int milliseconds = 1000;
};
struct CurrentSensor {
  static constexpr std::string_view unit = "A";
  static constexpr int milliseconds = 1000;
};

struct ServoSensor {
  static constexpr std::string_view unit = "rad";
  static constexpr int milliseconds = 10;
};

struct SubmarineSensorParameters {
  SensorOf<DepthSensor> depth{};
  SensorOf<PressureSensor> pressure{};
  SensorOf<ConductivitySensor> conductivity{};
  SensorOf<TemperatureSensor> water_temperature{};
  SensorOf<AttitudeSensor> imu_attitude{};
  SensorOf<RateSensor> imu_rates{};
  SensorOf<ForceSensor> imu_forces{};
  SensorOf<CompassSensor> compass{};
  SensorOf<SpeedSensor> speed_log{};
  SensorOf<RpmSensor> rpm{};
  SensorOf<PositionSensor> gps{};
  SensorOf<RangeSensor> range{};
  SensorOf<AltitudeSensor> altitude{};
  SensorOf<LeakSensor> leak{}, leak1{}, leak2{}, leak3{};
  SensorOf<SlowTemperatureSensor> hull_temperature{}, hull_temperature1{}, hull_temperature2{}, hull_temperature3{};
  SensorOf<VoltageSensor> voltage{};
  SensorOf<CurrentSensor> current{};
  SensorOf<ServoSensor> servos{};

  static constexpr auto fields() {
    using S = SubmarineSensorParameters;
    return describe(
        field<&S::depth>("", "depth, from a gauge of its own"), field<&S::pressure>("", "pressure, of the CTD"),
        field<&S::conductivity>("", "of the CTD"), field<&S::water_temperature>("", "of the CTD"),
        field<&S::imu_attitude>("", "roll, pitch and yaw of the IMU (3DM-GX1)"),
        field<&S::imu_rates>("", "body rates of the IMU"),
        field<&S::imu_forces>("", "specific forces of the IMU, along the body's axes"),
        field<&S::compass>("", "heading"),
        field<&S::speed_log>("", "velocity through the water, along the body's axes"),
        field<&S::rpm>("", "speed of the propeller"), field<&S::gps>("", "place, at the surface only"),
        field<&S::range>("", "to each acoustic transponder within reach"),
        field<&S::altitude>("", "over the sea floor, down the body's axis, no more than 100 m"),
        field<&S::leak>("", "1 for water in the hull: the first of four"), field<&S::leak1>("", "the second of them"),
        field<&S::leak2>("", "the third of them"), field<&S::leak3>("", "the fourth of them"),
        field<&S::hull_temperature>("", "inside the hull: the first of four"),
        field<&S::hull_temperature1>("", "the second of them"), field<&S::hull_temperature2>("", "the third of them"),
        field<&S::hull_temperature3>("", "the fourth of them"), field<&S::voltage>("", "of the battery"),
        field<&S::current>("", "from the battery"), field<&S::servos>("", "angle of each fin, at its servo"));
  }
};

}  // namespace jarol::vehicles
