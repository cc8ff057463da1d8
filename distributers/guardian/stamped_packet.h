// A packet that is kept and sent later, and then looks as if it had been made at that moment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "distributers/messages/message_set.h"

namespace jarol::distributers {

/// What changes in packets that are sent later, known without their message set: that of a plugin is not there where
/// the plugin is not loaded. Lies in memory as it is said to another process.
struct Stamping {
  static constexpr std::uint32_t none = 0xffffffff;

  std::uint32_t time_at = none;        // offset in bytes of the time, a double in s since 1970
  std::uint32_t checksum_from = none;  // offset of the first byte that is summed; the sum is the last two bytes
  messages::Checksum checksum = messages::Checksum::none;
  messages::ByteOrder order = messages::ByteOrder::little;
};

Stamping stamping_of(const messages::MessageSet& set);

/// Has the packet say that it is of now. One that is too short for that stays as it is.
void stamp(const Stamping& stamping, std::span<std::byte> packet);

}  // namespace jarol::distributers
