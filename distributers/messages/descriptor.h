// The form of a message set on the wire: constant tables, which tools/messages makes from specs/messages/*.xml.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <string_view>
#include <type_traits>

namespace jarol::messages {

struct MessageSet;

/// How a field is written. Integers and IEEE 754 numbers as they are; texts and bytes after their count (16 bits);
/// messages after their id, without header; lists after their count.
enum class Wire : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  fp32,
  fp64,
  plaintext,     // String
  rawdata,       // Sequence<std::uint8_t>
  rest,          // Sequence<std::uint8_t>: all that is left of the packet, without a count
  message,       // InlineMessage
  message_list,  // Sequence<InlineMessage>
};

/// Bytes of one element on the wire and in memory; 0 for what has no fixed size.
constexpr std::size_t size_of(Wire wire) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return wire <= Wire::fp64 ? sizes[static_cast<std::size_t>(wire)] : 0;
}

/// An enumerator, or a bit of a bitfield.
struct NamedValue {
  std::string_view name;
  std::int64_t value = 0;
};

/// A field as it stands on the wire. Those of parts stand among the message's own.
struct FieldDescriptor {
  std::string_view name;
  Wire wire = Wire::uint8;
  std::size_t offset = 0;      // of the member in the struct
  std::uint32_t count = 0;     // elements of a fixed array; 0: a single value
  bool digits = false;         // an array of ASCII digits and a NUL, shown as a number
  std::string_view type = {};  // as the definition spells it
  std::string_view unit = {};
  std::string_view text = {};
  std::string_view min = {};  // as the definition spells them; find_outside alone looks at them
  std::string_view max = {};
  std::string_view standard = {};           // default
  bool bits = false;                        // `values` are bits that may be combined
  std::span<const NamedValue> values = {};  // of an enumeration or bitfield
  std::string_view message_type = {};       // message or group that a nested message has to be of
  std::span<const std::uint32_t> ids = {};  // their ids; empty: any message of the set
};

/// A message: its fields, and its C++ struct for those who know only its form.
struct MessageDescriptor {
  std::string_view name;
  std::uint32_t id = 0;
  std::size_t index = 0;  // among the messages of the set
  std::string_view text;
  std::int64_t wire_size = 0;  // bytes of payload; -1: it depends on the value
  std::span<const FieldDescriptor> fields;
  const MessageSet& (*set)() = nullptr;

  std::size_t size = 0;  // of the struct
  std::size_t alignment = 1;
  bool flat = false;                      // it has no memory beside it: its bytes are all of it
  void (*construct)(void* to) = nullptr;  // default message into raw memory
  void (*assign)(void* to, const void* from) = nullptr;
  void (*destroy)(void* message) = nullptr;
};

/// The form of the struct M.
template <class M>
constexpr MessageDescriptor descriptor_of(std::string_view name, std::uint32_t id, std::size_t index,
                                          std::string_view text, std::int64_t wire_size,
                                          std::span<const FieldDescriptor> fields, const MessageSet& (*set)()) {
  static_assert(alignof(M) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);
  return {name,
          id,
          index,
          text,
          wire_size,
          fields,
          set,
          sizeof(M),
          alignof(M),
          std::is_trivially_copyable_v<M>,
          [](void* to) { new (to) M{}; },
          [](void* to, const void* from) { *static_cast<M*>(to) = *static_cast<const M*>(from); },
          [](void* message) { static_cast<M*>(message)->~M(); }};
}

}  // namespace jarol::messages
