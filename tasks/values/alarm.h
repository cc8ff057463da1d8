// What is wrong with the submarine.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::tasks {

/// Why the vehicle comes up; the first cause stays until the operator has it forgotten, but that water in the hull
/// takes its place.
enum class Alarm : std::uint8_t {
  none,
  operator_lost,
  depth_limit,
  altitude_limit,
  pitch_limit,
  voltage_limit,
  leak,
  depth_gauge,
  heading,
  attitude,
  forces,
  speed,
  altimeter,
  ctd,
  battery,
  gps,
  bottom_fin,
  port_fin,
  starboard_fin,
  top_fin,
  propeller,
  no_vehicle,
  vehicle_lost,
  leak1,
  leak2,
  leak3
};

constexpr auto enumerators(Alarm) {
  using enum Alarm;
  return std::array<Enumerator<Alarm>, 26>{
      {{"none", none},
       {"operator_lost", operator_lost, "it comes up, as the operator is silent"},
       {"depth_limit", depth_limit, "it comes up, as it is deeper than the limit, or would be before it levels off"},
       {"altitude_limit", altitude_limit,
        "it comes up, as it is too close to the sea floor, or would be before it levels off"},
       {"pitch_limit", pitch_limit, "it comes up, as its pitch is beyond the limit"},
       {"voltage_limit", voltage_limit, "it comes up, as the battery's voltage is below the limit"},
       {"leak", leak, "it comes up, as there is water at the first leak sensor, or that is silent"},
       {"depth_gauge", depth_gauge, "it comes up, as the depth gauge is silent or wrong"},
       {"heading", heading, "it comes up, as the compass is silent or wrong"},
       {"attitude", attitude, "it comes up, as the IMU's attitude or rates are silent or wrong"},
       {"forces", forces, "it comes up, as the IMU's forces are silent or wrong"},
       {"speed", speed, "it comes up, as the speed log or the propeller's speed is silent or wrong"},
       {"altimeter", altimeter, "it comes up, as the altimeter is silent or wrong"},
       {"ctd", ctd, "it comes up, as a sensor of the water is silent"},
       {"battery", battery, "it comes up, as voltage or current of the battery are not reported"},
       {"gps", gps, "it stays at the surface, as GPS is silent"},
       {"bottom_fin", bottom_fin, "it comes up, as the bottom rudder is stuck or its servo silent"},
       {"port_fin", port_fin, "it comes up, as the port elevator is stuck or its servo silent"},
       {"starboard_fin", starboard_fin, "it comes up, as the starboard elevator is stuck or its servo silent"},
       {"top_fin", top_fin, "it comes up, as the top rudder is stuck or its servo silent"},
       {"propeller", propeller, "it comes up, as the propeller does not turn as it is sent"},
       {"no_vehicle", no_vehicle, "nothing was heard of the vehicle yet; it begins when that is"},
       {"vehicle_lost", vehicle_lost, "it is to come up, as nothing arrives from the vehicle"},
       {"leak1", leak1, "it comes up, as there is water at the second leak sensor, or that is silent"},
       {"leak2", leak2, "it comes up, as there is water at the third leak sensor, or that is silent"},
       {"leak3", leak3, "it comes up, as there is water at the fourth leak sensor, or that is silent"}}};
}

/// Whether anything finds a fin that sticks; and where that does not end the dive, which one does.
enum class FinCheck : std::uint8_t {
  checked,
  unchecked,
  bottom_failed,
  port_failed,
  starboard_failed,
  top_failed,
  several_failed
};

constexpr auto enumerators(FinCheck) {
  using enum FinCheck;
  return std::array<Enumerator<FinCheck>, 7>{
      {{"checked", checked},
       {"unchecked", unchecked, "no fin is checked, as no servo reports where it is"},
       {"bottom_failed", bottom_failed, "the bottom rudder is stuck or its servo silent"},
       {"port_failed", port_failed, "the port elevator is stuck or its servo silent"},
       {"starboard_failed", starboard_failed, "the starboard elevator is stuck or its servo silent"},
       {"top_failed", top_failed, "the top rudder is stuck or its servo silent"},
       {"several_failed", several_failed, "several fins are stuck or their servos silent"}}};
}

struct Condition {
  Alarm alarm = Alarm::none;
  FinCheck fins = FinCheck::checked;

  static constexpr auto fields() {
    return describe(
        field<&Condition::alarm>("", "why it comes up, or none"),
        field<&Condition::fins>("", "by what their servos report; which one has failed if that ends no dive"));
  }
};

}  // namespace jarol::tasks
