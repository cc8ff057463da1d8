// What goes into the submarine and comes out of it.
#pragma once

#include <limits>
#include <numbers>
#include <vector>

#include "distributers/interfaces/vehicle.h"
#include "graph/values/describe.h"

namespace jarol::vehicles {

struct SubmarineInputs {
  double thruster = 0.0;
  double fin0 = 0.0;
  double fin1 = 0.0;
  double fin2 = 0.0;
  double fin3 = 0.0;

  static std::vector<Range> ranges() {
    constexpr Range angle{-std::numbers::pi / 2, std::numbers::pi / 2};
    return {{-1, 1}, angle, angle, angle, angle};
  }

  static constexpr auto fields() {
    using S = SubmarineInputs;
    return describe(field<&S::thruster>("", "commanded actuation, full astern to full ahead"),
                    field<&S::fin0>("rad", "commanded angle of the bottom rudder, positive turns to port"),
                    field<&S::fin1>("rad", "commanded angle of the port elevator, positive noses down"),
                    field<&S::fin2>("rad", "commanded angle of the starboard elevator, positive noses down"),
                    field<&S::fin3>("rad", "commanded angle of the top rudder, positive turns to port"));
  }
};

struct SubmarineActuators {
  double propeller = 0.0;
  double fin0 = 0.0;
  double fin1 = 0.0;
  double fin2 = 0.0;
  double fin3 = 0.0;

  static constexpr auto fields() {
    using S = SubmarineActuators;
    return describe(
        field<&S::propeller>("rad/s", "speed of the propeller"), field<&S::fin0>("rad", "angle of the bottom rudder"),
        field<&S::fin1>("rad", "angle of the port elevator"), field<&S::fin2>("rad", "angle of the starboard elevator"),
        field<&S::fin3>("rad", "angle of the top rudder"));
  }
};

/// The newest reading of each sensor, NaN before the first.
struct SubmarineReadings {
  double depth = unknown;
  double pressure = unknown;
  double conductivity = unknown;
  double water_temperature = unknown;
  double salinity = unknown;
  double sound_speed = unknown;
  double phi = unknown;
  double theta = unknown;
  double psi = unknown;
  double p = unknown;
  double q = unknown;
  double r = unknown;
  double f_x = unknown;
  double f_y = unknown;
  double f_z = unknown;
  double heading = unknown;
  double u = unknown;
  double v = unknown;
  double w = unknown;
  double rpm = unknown;
  double gps_north = unknown;
  double gps_east = unknown;
  double altitude = unknown;
  double leak = unknown;
  double hull_temperature = unknown;
  double voltage = unknown;
  double current = unknown;
  double range_first = unknown;
  double range_second = unknown;

  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  static constexpr auto fields() {
    using S = SubmarineReadings;
    return describe(
        field<&S::depth>("m", "of the depth gauge"), field<&S::pressure>("hPa", "of the CTD"),
        field<&S::conductivity>("S/m", "of the CTD"), field<&S::water_temperature>("degC", "of the CTD"),
        field<&S::salinity>("", "practical salinity, from conductivity and temperature"),
        field<&S::sound_speed>("m/s", "from the CTD"), field<&S::phi>("rad", "roll of the IMU"),
        field<&S::theta>("rad", "pitch of the IMU"), field<&S::psi>("rad", "yaw of the IMU"),
        field<&S::p>("rad/s", "roll rate of the IMU"), field<&S::q>("rad/s", "pitch rate of the IMU"),
        field<&S::r>("rad/s", "yaw rate of the IMU"), field<&S::f_x>("m/s^2", "specific force forward"),
        field<&S::f_y>("m/s^2", "specific force to the right"), field<&S::f_z>("m/s^2", "specific force down"),
        field<&S::heading>("rad", "of the compass"), field<&S::u>("m/s", "of the speed log, forward"),
        field<&S::v>("m/s", "of the speed log, to the right"), field<&S::w>("m/s", "of the speed log, down"),
        field<&S::rpm>("rpm", "speed of the propeller"), field<&S::gps_north>("m", "north of the origin"),
        field<&S::gps_east>("m", "east of the origin"), field<&S::altitude>("m", "over the sea floor"),
        field<&S::leak>("", "1 for water in the hull, of the first leak sensor"),
        field<&S::hull_temperature>("degC", "inside the hull, of the first sensor"),
        field<&S::voltage>("V", "of the battery"), field<&S::current>("A", "from the battery"),
        field<&S::range_first>("m", "to the first transponder"), field<&S::range_second>("m", "to the second one"));
  }
};

/// Those of the hull of which there are four, but the first.
struct SubmarineHullReadings {
  double leak1 = SubmarineReadings::unknown;
  double leak2 = SubmarineReadings::unknown;
  double leak3 = SubmarineReadings::unknown;
  double hull_temperature1 = SubmarineReadings::unknown;
  double hull_temperature2 = SubmarineReadings::unknown;
  double hull_temperature3 = SubmarineReadings::unknown;

  static constexpr auto fields() {
    using S = SubmarineHullReadings;
    return describe(field<&S::leak1>("", "1 for water in the hull, of the second leak sensor"),
                    field<&S::leak2>("", "of the third one"), field<&S::leak3>("", "of the fourth one"),
                    field<&S::hull_temperature1>("degC", "inside the hull, of the second sensor"),
                    field<&S::hull_temperature2>("degC", "of the third one"),
                    field<&S::hull_temperature3>("degC", "of the fourth one"));
  }
};

struct SubmarineOutputs {
  SubmarineActuators actuators{};
  SubmarineReadings sensors{};
  SubmarineHullReadings hull{};

  static constexpr auto fields() {
    using S = SubmarineOutputs;
    return describe(field<&S::actuators>("", "what the actuators do"),
                    field<&S::sensors>("", "what the sensors reported last"),
                    field<&S::hull>("", "likewise, the further ones of the hull"));
  }
};

}  // namespace jarol::vehicles
