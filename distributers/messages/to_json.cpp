#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "distributers/messages/bytes.h"
#include "distributers/messages/json.h"
#include "distributers/messages/payload.h"

namespace jarol::messages {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = Sequence<std::uint8_t>;
using List = Sequence<InlineMessage>;

Json json_of(MessageRef message);

std::string hex_of(const void* bytes, std::size_t size) {
  std::string hex;
  for (std::size_t i = 0; i < size; ++i) {
    const auto byte = static_cast<const unsigned char*>(bytes)[i];
    hex += "0123456789abcdef"[byte / 16];
    hex += "0123456789abcdef"[byte % 16];
  }
  return hex;
}

template <class Number, class Bits>
Json json_of_floating(const void* from) {
  Number number;
  std::memcpy(&number, from, sizeof number);
  if (std::isfinite(number)) return static_cast<double>(number);
  if (std::isinf(number)) return number > 0 ? "Infinity" : "-Infinity";
  if (std::bit_cast<Bits>(number) == std::bit_cast<Bits>(std::numeric_limits<Number>::quiet_NaN())) return "NaN";
  Bits bits;
  std::memcpy(&bits, from, sizeof bits);
  std::string text = "0x";
  for (std::size_t i = 2 * sizeof bits; i-- > 0;) text += "0123456789abcdef"[(bits >> (4 * i)) & 15];
  return text;
}

template <class Integer>
Json json_of_integer(const void* from) {
  Integer integer;
  std::memcpy(&integer, from, sizeof integer);
  return integer;
}

Json json_of_number(Wire wire, const void* from) {
  switch (wire) {
    case Wire::int8: return json_of_integer<std::int8_t>(from);
    case Wire::uint8: return json_of_integer<std::uint8_t>(from);
    case Wire::int16: return json_of_integer<std::int16_t>(from);
    case Wire::uint16: return json_of_integer<std::uint16_t>(from);
    case Wire::int32: return json_of_integer<std::int32_t>(from);
    case Wire::uint32: return json_of_integer<std::uint32_t>(from);
    case Wire::int64: return json_of_integer<std::int64_t>(from);
    case Wire::uint64: return json_of_integer<std::uint64_t>(from);
    case Wire::fp32: return json_of_floating<float, std::uint32_t>(from);
    default: return json_of_floating<double, std::uint64_t>(from);
  }
}

Json json_of_array(const FieldDescriptor& field, const void* from) {
  if (field.digits) {
    // a number only if writing that number gives the same bytes
    const auto* const digits = static_cast<const unsigned char*>(from);
    std::uint64_t number = 0;
    bool all = digits[field.count - 1] == 0;
    for (std::uint32_t i = 0; i + 1 < field.count; ++i) {
      all = all && digits[i] >= '0' && digits[i] <= '9';
      number = 10 * number + (digits[i] - '0');
    }
    return all ? Json(number) : Json{{"hex", hex_of(from, field.count)}};
  }
  Json array = Json::array();
  for (std::uint32_t i = 0; i < field.count; ++i)
    array.push_back(json_of_number(field.wire, static_cast<const std::byte*>(from) + i * size_of(field.wire)));
  return array;
}

bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(Json(text).dump());
    return true;
  } catch (const Json::type_error&) { return false; }
}

Json json_of_inline(const MessageSet& set, const InlineMessage& from) {
  if (from.empty()) return nullptr;
  Message message;
  std::string why;
  if (!take_inline(set, from, message, &why))
    return {{"mgid", from.id}, {"hex", hex_of(from.payload.data(), from.payload.size())}, {"error", why}};
  return {{"abbrev", message.descriptor()->name}, {"mgid", from.id}, {"fields", json_of(message)}};
}

Json json_of_field(const MessageSet& set, const FieldDescriptor& field, const void* from) {
  switch (field.wire) {
    case Wire::plaintext: {
      const std::string text(static_cast<const String*>(from)->view());
      return is_utf8(text) ? Json(text) : Json{{"hex", hex_of(text.data(), text.size())}};
    }
    case Wire::rawdata:
    case Wire::rest: {
      const auto& bytes = *static_cast<const Bytes*>(from);
      return hex_of(bytes.data(), bytes.size());
    }
    case Wire::message: return json_of_inline(set, *static_cast<const InlineMessage*>(from));
    case Wire::message_list: {
      Json list = Json::array();
      for (const InlineMessage& element : *static_cast<const List*>(from)) list.push_back(json_of_inline(set, element));
      return list;
    }
    default: return field.count > 0 ? json_of_array(field, from) : json_of_number(field.wire, from);
  }
}

Json json_of(MessageRef message) {
  Json object = Json::object();
  for (const FieldDescriptor& field : message.descriptor->fields)
    object[std::string(field.name)] =
        json_of_field(message.descriptor->set(), field, static_cast<const std::byte*>(message.value) + field.offset);
  return object;
}

}  // namespace

std::string to_json(MessageRef message) { return json_of(message).dump(-1, ' ', true); }

}  // namespace jarol::messages
