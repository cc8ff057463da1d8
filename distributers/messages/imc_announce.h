// How a system of IMC tells that it is there.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "distributers/messages/imc.h"

namespace jarol::messages::imc {

/// Who announces itself; the address as in "udp://127.0.0.1:6001", empty where it can't be reached.
struct System {
  std::string_view name;
  std::int64_t type = 0;               // SystemType
  double latitude = 0, longitude = 0;  // rad, WGS-84
  std::string_view address;
};

/// DUNE's.
inline constexpr std::chrono::nanoseconds announce_period = std::chrono::seconds(10);
Announce make_announce(const System& system);

}  // namespace jarol::messages::imc
