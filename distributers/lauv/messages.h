// Messages of IMC that are made from values of the core.
#pragma once

#include <string_view>

#include "distributers/messages/imc.h"
#include "graph/language/quantities.h"
#include "tasks/values/lauv.h"

namespace jarol::distributers {

/// Entities of the vehicle as its operator knows them, by label and id.
inline constexpr std::string_view operator_entity = "Operator";
inline constexpr std::string_view supervisor_entity = "Supervisor";
inline constexpr std::string_view entities_known = "Daemon=0;Operator=1;Supervisor=2";

/// EstimatedState about an origin, latitude and longitude in rad; the altitude is not known.
messages::imc::EstimatedState estimate_state(const tasks::Motion& motion, double latitude, double longitude);

/// Who announces itself; the address as in "udp://127.0.0.1:6001", empty where it can't be reached.
struct System {
  std::string_view name;
  std::int64_t type = 0;  // SystemType
  double latitude = 0, longitude = 0;
  std::string_view address;
};

constexpr Duration announce_period = std::chrono::seconds(10);
messages::imc::Announce make_announce(const System& system);

}  // namespace jarol::distributers
