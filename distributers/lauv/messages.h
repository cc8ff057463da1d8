// Messages of IMC that are made from values of the core.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "distributers/messages/imc.h"
#include "graph/language/quantities.h"
#include "tasks/values/guidance.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {

/// Entities of the vehicle as its operator knows them, by label and id.
inline constexpr std::array<std::string_view, 5> entities_known{"Daemon", "Operator", "Supervisor", "Navigation",
                                                                "Plan Engine"};
inline constexpr std::uint8_t daemon_entity = 0, operator_entity = 1, supervisor_entity = 2, navigation_entity = 3,
                              plan_entity = 4;

std::string_view name_of(tasks::Alarm alarm);
std::string_view meaning_of(tasks::FinCheck fins);

/// Now, in s since 1970: for the eyes of who reads it, never for what a run does.
double unix_time();

/// EstimatedState about an origin, latitude and longitude in rad; an altitude below 0 is not known. Its body velocities
/// are those through the water, as `motion` has them, those north and east over ground.
messages::imc::EstimatedState estimate_state(const tasks::Motion& motion, const tasks::Stream& stream, double latitude,
                                             double longitude, double altitude);

}  // namespace jarol::distributers
