// Whether stamps can be: a sender's clock may report any time, but goes on about as fast as this machine's.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "distributers/messages/message.h"
#include "distributers/messages/message_set.h"

namespace jarol::distributers {

/// A stamp is held against the clock of its source, as the latest of its stamps that were taken reports it. One that is
/// far ahead of that is refused, unless it is nearer to this machine's own time (then the one before was old); so is
/// one that is far behind. Systems do send again what they said long ago: DUNE answers a new peer with a message that
/// it made when it began to log. When nothing of a source was taken for as long as a peer may be silent, its clock was
/// set, or it is another system: it begins anew.
class StampLimits {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds max_ahead{10}, max_behind{600};
  /// s since 1970, as IMC counts: what a clock can show that was never set, and the year 2200. What is outside is no
  /// time, and no clock of a sender begins with it.
  static constexpr double earliest = 0, latest = 7'258'118'400;

  StampLimits(const messages::MessageSet& set, std::chrono::nanoseconds silence);

  enum class Finding : std::uint8_t { good, no_time, ahead, behind };
  static constexpr std::size_t finding_count = 4;
  /// `here`: this machine's own time, in the unit of stamps.
  Finding look(messages::MessageRef header, Clock::time_point now, double here);

  /// A stream begins.
  void begin() { sources_ = {}; }

 private:
  struct Source {
    bool used = false;
    std::uint64_t id = 0;
    double lead = 0;  // s, of its clock before `now`
    Clock::time_point taken{};
  };
  Source& find(std::uint64_t id);

  std::chrono::nanoseconds silence_;
  const messages::FieldDescriptor* time_ = nullptr;
  const messages::FieldDescriptor* source_ = nullptr;
  std::array<Source, 16> sources_{};  // the one that was heard longest ago makes room
};

}  // namespace jarol::distributers
