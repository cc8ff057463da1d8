// Messages of IMC that are made from values of the core.
#pragma once

#include <string>
#include <string_view>

#include "distributers/messages/imc.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {

/// Entities of the vehicle as its operator knows them, by label and id.
inline constexpr std::string_view operator_entity = "Operator";
inline constexpr std::string_view supervisor_entity = "Supervisor";
inline constexpr std::string_view entities_known = "Daemon=0;Operator=1;Supervisor=2";

/// EstimatedState about an origin, latitude and longitude in rad; the altitude is not known.
messages::imc::EstimatedState estimate_state(const tasks::Motion& motion, double latitude, double longitude);

/// Announce of an unmanned underwater vehicle that can be reached at an address as in "udp://127.0.0.1:6001", or
/// nowhere if that is empty.
messages::imc::Announce make_announce(std::string_view name, double latitude, double longitude,
                                      const std::string& address);

}  // namespace jarol::distributers
