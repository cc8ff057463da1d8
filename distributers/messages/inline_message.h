// A message inside a message: its id and its payload, of any message of the set.
#pragma once

#include "graph/values/type_of.h"

namespace jarol::messages {

/// A field of a message that holds another one, or none. The payload is little-endian whatever the packet's order was.
struct InlineMessage {
  static constexpr std::uint32_t none = 0xffffffff;

  std::uint32_t id = none;
  Sequence<std::uint8_t> payload;

  bool empty() const { return id == none; }
  friend bool operator==(const InlineMessage&, const InlineMessage&) = default;

  static constexpr auto fields() {
    return describe(field<&InlineMessage::id>("", "of the message, 4294967295: none"),
                    field<&InlineMessage::payload>("", "its fields in little-endian order"));
  }
};

}  // namespace jarol::messages
