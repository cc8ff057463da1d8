// What goes into the submarine and comes out of it.
#pragma once

#include <numbers>
#include <vector>

#include "graph/values/describe.h"
#include "vehicles/vehicle.h"

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

struct SubmarineOutputs {
  SubmarineActuators actuators{};

  static constexpr auto fields() {
    using S = SubmarineOutputs;
    return describe(field<&S::actuators>("", "what the actuators do"));
  }
};

}  // namespace jarol::vehicles
