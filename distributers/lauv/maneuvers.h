// IMC's maneuvers as legs that guidance follows.
#pragma once

#include <string>
#include <vector>

#include "distributers/lauv/flight_limits.h"
#include "distributers/messages/inline_message.h"
#include "tasks/values/guidance.h"

namespace jarol::distributers {

/// Where north and east are measured from: latitude and longitude in rad, WGS-84.
struct Origin {
  double latitude = 0, longitude = 0;
  double furthest = 100e3;  // m, of places that are gone to: the ground is flat there
};

struct PlannedLeg {
  tasks::Leg leg{};
  bool here = false;  // its place is where the vehicle is when it begins
};

struct Maneuver {
  std::string name{};              // in its plan
  std::uint32_t type = 0;          // id of its message
  double timeout = 0;              // s; 0: none
  std::vector<PlannedLeg> legs{};  // none: it is steered by who sends references or turns a stick

  // of FollowReference
  std::uint16_t control_source = 0;
  std::uint8_t control_entity = 0;
  double loiter_radius = 0;
};

/// Of a circle where the maneuver names none, in m.
constexpr double default_radius = 10;

/// In m from the origin. Throws InputError for a place that is none, or too far away to be meant.
void set_place(tasks::Leg& leg, double latitude, double longitude, const Origin& origin);
/// Throw InputError for what can't be commanded. `name`: of the depth or altitude.
void set_level(tasks::Leg& leg, double z, std::uint8_t units, const FlightLimits& limits, const char* name = "z");
void set_speed(tasks::Leg& leg, double speed, std::uint8_t units, const FlightLimits& limits);

/// Throws InputError that says what can't be flown.
Maneuver make_maneuver(const messages::InlineMessage& message, const Origin& origin, const FlightLimits& limits = {});

/// Does it go by where the vehicle is? One that comes up for a fix does not.
bool needs_place(const Maneuver& maneuver);
/// Does it keep an altitude?
bool needs_altitude(const Maneuver& maneuver);

}  // namespace jarol::distributers
