// What the submarine's instruments report, as it comes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::tasks {

/// The newest reading of an instrument, and how many came so far: one that counts no further is lost; -1: there is
/// none, as it is not fitted.
struct Reading {
  double value = 0;
  std::int64_t count = 0;

  static constexpr auto fields() {
    return describe(field<&Reading::value>("", "in the instrument's unit"),
                    field<&Reading::count>("", "so far; -1: not fitted"));
  }
};

struct VectorReading {
  double x = 0, y = 0, z = 0;
  std::int64_t count = 0;

  static constexpr auto fields() {
    using V = VectorReading;
    return describe(field<&V::x>("", "in the instrument's unit"), field<&V::y>(), field<&V::z>(),
                    field<&V::count>("", "so far; -1: not fitted"));
  }
};

/// The newest range to an acoustic transponder, and where that lies.
struct BeaconReading {
  double north = 0, east = 0, depth = 0;
  double range = 0;
  std::int64_t count = 0;

  static constexpr auto fields() {
    using B = BeaconReading;
    return describe(field<&B::north>("m", "of the origin"), field<&B::east>("m", "of the origin"),
                    field<&B::depth>("m", "below the surface"), field<&B::range>("m", "from the vehicle"),
                    field<&B::count>("", "ranges so far; -1: not fitted"));
  }
};

struct Instruments {
  Reading depth{};
  Reading pressure{};
  VectorReading attitude{};
  VectorReading rates{};
  VectorReading forces{};
  Reading heading{};
  VectorReading velocity{};
  Reading rpm{};
  VectorReading place{};
  Reading altitude{};
  Reading conductivity{};
  Reading water_temperature{};
  Reading leak{}, leak1{}, leak2{}, leak3{};
  Reading hull_temperature{}, hull_temperature1{}, hull_temperature2{}, hull_temperature3{};
  Reading voltage{};
  Reading current{};
  std::array<BeaconReading, 2> beacons{};
  double latitude = 0, longitude = 0;

  static constexpr auto fields() {
    using I = Instruments;
    return describe(
        field<&I::depth>("", "m, of the depth gauge"), field<&I::pressure>("", "hPa, of the CTD"),
        field<&I::attitude>("", "rad: roll, pitch, yaw of the IMU"),
        field<&I::rates>("", "rad/s: body rates of the IMU"),
        field<&I::forces>("", "m/s^2: specific forces of the IMU"), field<&I::heading>("", "rad, of the compass"),
        field<&I::velocity>("", "m/s through the water, body axes"), field<&I::rpm>("", "rpm, of the propeller"),
        field<&I::place>("", "m north and east of the origin, of GPS"), field<&I::altitude>("", "m over the sea floor"),
        field<&I::conductivity>("", "S/m, of the CTD"), field<&I::water_temperature>("", "degC, of the CTD"),
        field<&I::leak>("", "1 for water in the hull, of the first leak sensor"),
        field<&I::leak1>("", "of the second leak sensor"), field<&I::leak2>("", "of the third leak sensor"),
        field<&I::leak3>("", "of the fourth leak sensor"),
        field<&I::hull_temperature>("", "degC, inside the hull, of the first sensor"),
        field<&I::hull_temperature1>("", "degC, of the second sensor"),
        field<&I::hull_temperature2>("", "degC, of the third sensor"),
        field<&I::hull_temperature3>("", "degC, of the fourth sensor"), field<&I::voltage>("", "V, of the battery"),
        field<&I::current>("", "A, from the battery"), field<&I::beacons>("", "acoustic transponders"),
        field<&I::latitude>("rad", "of the origin, WGS-84"), field<&I::longitude>("rad", "of the origin"));
  }
};

/// As many leak sensors and as many of the hull's temperatures, in their order.
inline constexpr std::size_t hull_sensors = 4;
inline constexpr std::array<Reading Instruments::*, hull_sensors> leak_readings{
    &Instruments::leak, &Instruments::leak1, &Instruments::leak2, &Instruments::leak3};
inline constexpr std::array<Reading Instruments::*, hull_sensors> hull_readings{
    &Instruments::hull_temperature, &Instruments::hull_temperature1, &Instruments::hull_temperature2,
    &Instruments::hull_temperature3};

/// The line to the operator.
struct Contact {
  double silence = 0;
  std::uint32_t stops = 0;

  static constexpr auto fields() {
    return describe(field<&Contact::silence>("s", "since the operator was heard last"),
                    field<&Contact::stops>("", "of all that goes on, that the operator demanded so far"));
  }
};

}  // namespace jarol::tasks
