// A packet that is kept and sent later, and then looks as if it had been made at that moment.
#pragma once

#include <span>
#include <vector>

#include "distributers/messages/packet.h"

namespace jarol::distributers {

class StampedPacket {
 public:
  /// Bytes that are no packet of the set are kept as they are.
  StampedPacket(const messages::MessageSet& set, std::span<const std::byte> packet);

  /// With the time and the checksum of now; valid until the next call.
  std::span<const std::byte> bytes();

 private:
  const messages::MessageSet& set_;
  const messages::FieldForm* timestamp_;
  messages::Message header_, message_;  // none: it could not be read
  std::vector<std::byte> bytes_;
};

}  // namespace jarol::distributers
