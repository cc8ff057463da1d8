// What is wrong with the submarine.
#pragma once

#include <array>
#include <cstdint>

#include "graph/values/describe.h"

namespace jarol::tasks {

/// Why the vehicle comes up; the first cause stays until the operator has it forgotten.
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
  gps
};

constexpr auto enumerators(Alarm) {
  using enum Alarm;
  return std::array<Enumerator<Alarm>, 16>{{{"none", none},
                                            {"operator_lost", operator_lost},
                                            {"depth_limit", depth_limit},
                                            {"altitude_limit", altitude_limit},
                                            {"pitch_limit", pitch_limit},
                                            {"voltage_limit", voltage_limit},
                                            {"leak", leak},
                                            {"depth_gauge", depth_gauge},
                                            {"heading", heading},
                                            {"attitude", attitude},
                                            {"forces", forces},
                                            {"speed", speed},
                                            {"altimeter", altimeter},
                                            {"ctd", ctd},
                                            {"battery", battery},
                                            {"gps", gps}}};
}

struct Condition {
  Alarm alarm = Alarm::none;

  static constexpr auto fields() { return describe(field<&Condition::alarm>("", "why it comes up, or none")); }
};

}  // namespace jarol::tasks
