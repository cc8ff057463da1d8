// A message set: framing and messages. `imc` and `javiator` are made from specs/messages/.
#pragma once

#include <span>
#include <string_view>

#include "distributers/messages/descriptor.h"

namespace jarol::messages {

enum class ByteOrder : std::uint8_t { little, big };

enum class Checksum : std::uint8_t {
  none,
  crc16_ibm,  // polynomial 0x8005 reflected, from 0
  sum16,      // of bytes, modulo 65536
};

/// A packet is header, payload and checksum. The header is a message of its own form, of fixed size.
struct MessageSet {
  std::string_view name;
  std::string_view title;
  std::string_view version;
  std::string_view text;

  const MessageDescriptor* header = nullptr;
  // which fields of the header they are
  std::size_t sync_field = 0;  // always the first
  std::size_t id_field = 0;
  std::size_t size_field = 0;  // bytes of payload
  std::uint64_t sync = 0;      // written in the packet's byte order

  ByteOrder order = ByteOrder::little;
  bool either_order = false;  // the sync of a packet reports its order; `order` is what we send
  Checksum checksum = Checksum::none;
  std::size_t checksum_from = 0;  // offset of the first byte summed
  std::string_view checksum_name;
  std::size_t max_payload = 0;  // bytes

  std::span<const MessageDescriptor* const> messages;  // by id, then by size

  /// The message of that id, or null. Where messages of fixed sizes share an id, that of the payload's size, else the
  /// first of them.
  const MessageDescriptor* find(std::uint32_t id, std::size_t payload) const;
  const MessageDescriptor* find(std::string_view name) const;
  /// The message of that id that may stand in another, or null: one alone in its id, with an end of its own.
  const MessageDescriptor* find_nested(std::uint32_t id) const;

  std::size_t header_size() const { return static_cast<std::size_t>(header->wire_size); }
  std::size_t footer_size() const { return checksum == Checksum::none ? 0 : 2; }
  std::size_t sync_size() const { return size_of(header->fields[sync_field].wire); }
  Wire id_wire() const { return header->fields[id_field].wire; }
  /// Stands where a message could, and is none.
  std::uint32_t no_id() const { return 0xffffffffU >> (32 - 8 * size_of(id_wire())); }
};

/// All sets, by name.
std::span<const MessageSet* const> message_sets();

}  // namespace jarol::messages
