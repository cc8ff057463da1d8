// Packets: header, payload and checksum to bytes and back. Whatever the bytes are, there is an answer.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "distributers/messages/message.h"
#include "distributers/messages/message_set.h"

namespace jarol::messages {

/// Why bytes are no packet that can be used.
enum class PacketError : std::uint8_t { none, garbage, truncated, oversized, checksum, unknown_id, payload };
constexpr std::size_t packet_error_count = 7;

/// In words, as in "bad checksum".
std::string_view name_of(PacketError packet_error);

/// The byte order that the sync at the begin of the bytes reports, if it is one; there are bytes enough for it.
std::optional<ByteOrder> order_of(const MessageSet& set, const std::byte* bytes);

/// What a header says of its packet.
struct Announced {
  std::uint32_t id = 0;
  std::size_t payload = 0;  // bytes
};

/// The header is there as a whole.
Announced read_header(const MessageSet& set, const std::byte* header, ByteOrder order);

/// Reads packets into messages that it keeps, one of each form: of a form that came before, nothing is allocated but
/// for longer texts and lists.
class PacketReader {
 public:
  explicit PacketReader(const MessageSet& set);

  /// Reads bytes that should be one packet and nothing else. With a wrong checksum, header and message are there all
  /// the same, so that they can be shown, if they could be read; with any other flaw the message has no form. `why`,
  /// where given, says what is wrong.
  PacketError read(std::span<const std::byte> bytes, std::string* why = nullptr);

  /// The first half of that: the same answer, but of the message only form and payload are there.
  PacketError check(std::span<const std::byte> bytes, std::string* why = nullptr);
  /// The other half, while the bytes that were checked are there.
  MessageRef take();

  const MessageSet& set() const { return set_; }
  ByteOrder order() const { return order_; }
  MessageRef header() const { return header_; }
  MessageRef message() const { return message_; }
  const MessageDescriptor* descriptor() const { return descriptor_; }
  std::span<const std::byte> payload() const { return payload_; }

 private:
  const MessageSet& set_;
  ByteOrder order_ = ByteOrder::little;
  Message header_;
  const MessageDescriptor* descriptor_ = nullptr;
  std::span<const std::byte> payload_;
  std::vector<Message> kept_;  // of the form of the same index in the set
  MessageRef message_;
};

/// Replaces `to` by the packet; sync, id, size and checksum are set here, whatever the header says. False if it can't
/// be written: then `to` is empty, and `why`, where given, says what is wrong.
bool write_packet(MessageRef header, MessageRef message, ByteOrder order, std::vector<std::byte>& to,
                  std::string* why = nullptr);

}  // namespace jarol::messages
