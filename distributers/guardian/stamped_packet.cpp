#include "distributers/guardian/stamped_packet.h"

#include "distributers/links/timestamp.h"

namespace jarol::distributers {

StampedPacket::StampedPacket(const messages::MessageSet& set, std::span<const std::byte> packet)
    : set_(set), timestamp_(find_timestamp(set)), bytes_(packet.begin(), packet.end()) {
  messages::PacketReader reader(set);
  if (reader.read(packet) != messages::Flaw::none) return;
  header_ = messages::Message(reader.header());
  message_ = messages::Message(reader.message());
}

std::span<const std::byte> StampedPacket::bytes() {
  if (message_.form() != nullptr) {
    set_timestamp(timestamp_, header_.value());
    write_packet(header_, message_, set_.order, bytes_);
  }
  return bytes_;
}

}  // namespace jarol::distributers
