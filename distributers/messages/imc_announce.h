// How a system of IMC announces itself.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
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

Announce make_announce(const System& system);

/// When a system announces itself: at once, and then every 10 s, as DUNE does.
class AnnounceTimer {
 public:
  /// Counts from an instant at which it is due.
  bool is_due(std::chrono::nanoseconds instant) {
    if (last_ && instant - *last_ < std::chrono::seconds(10)) return false;
    last_ = instant;
    return true;
  }

 private:
  std::optional<std::chrono::nanoseconds> last_;
};

}  // namespace jarol::messages::imc
