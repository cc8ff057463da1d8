#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "distributers/messages/json.h"
#include "distributers/messages/payload.h"
#include "graph/language/problems.h"

namespace jarol::messages {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = Sequence<std::uint8_t>;
using List = Sequence<InlineMessage>;

// What is wrong, which ends the reading at once.
struct Wrong {
  std::string text;
};

void read_object(const Json& object, Message& message, int depth);

std::string shown(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() <= 40 ? text : text.substr(0, 37) + "...";
}

[[noreturn]] void fail(const Json& json, const std::string& needed) {
  throw Wrong{"is " + shown(json) + "; it needs " + needed};
}

void read_hex(const Json& json, std::size_t size, Bytes& to) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  const std::string needed =
      "two hexadecimal digits a byte" + (size == 0 ? "" : ", for " + std::to_string(size) + " bytes");
  if (!json.is_string()) fail(json, needed);
  const auto& text = json.get_ref<const std::string&>();
  if (text.size() % 2 != 0 || (size != 0 && text.size() != 2 * size)) fail(json, needed);
  to.resize(text.size() / 2);
  for (std::size_t i = 0; i < to.size(); ++i) {
    const int high = digit(text[2 * i]), low = digit(text[2 * i + 1]);
    if (high < 0 || low < 0) fail(json, needed);
    to[i] = static_cast<std::uint8_t>(16 * high + low);
  }
}

// The integer that a name, or a list of names of bits, stands for.
std::optional<std::int64_t> named_value(const FieldDescriptor& field, const Json& json) {
  const auto find = [&](const Json& name) -> std::optional<std::int64_t> {
    if (!name.is_string()) return std::nullopt;
    for (const NamedValue& v : field.values)
      if (v.name == name.get_ref<const std::string&>()) return v.value;
    return std::nullopt;
  };
  if (!field.bits || !json.is_array()) return find(json);
  std::int64_t sum = 0;
  for (const Json& name : json) {
    const auto bit = find(name);
    if (!bit) return std::nullopt;
    sum |= *bit;
  }
  return sum;
}

std::string names_text(const FieldDescriptor& field) {
  if (field.values.empty()) return "";
  std::vector<std::string> names;
  for (const NamedValue& v : field.values) names.emplace_back(v.name);
  return (field.bits ? ", or a list of: " : ", or one of: ") + list_of(names);
}

template <class Integer>
void read_integer(const FieldDescriptor& field, const Json& json, void* to) {
  constexpr auto min = std::numeric_limits<Integer>::min(), max = std::numeric_limits<Integer>::max();
  std::optional<Integer> integer;
  if (const auto named = named_value(field, json)) {
    if (std::in_range<Integer>(*named)) integer = static_cast<Integer>(*named);
  } else if (json.is_number_unsigned()) {
    const auto value = json.get<std::uint64_t>();
    if (std::in_range<Integer>(value)) integer = static_cast<Integer>(value);
  } else if (json.is_number_integer()) {
    const auto value = json.get<std::int64_t>();
    if (std::in_range<Integer>(value)) integer = static_cast<Integer>(value);
  }
  if (!integer) fail(json, "an integer from " + std::to_string(min) + " to " + std::to_string(max) + names_text(field));
  std::memcpy(to, &*integer, sizeof(Integer));
}

template <class Number, class Bits>
void read_floating(const Json& json, void* to) {
  const char* const needed = R"(a number, "NaN", "Infinity", "-Infinity", or bits as in "0x7fc00001")";
  Number number = 0;
  if (json.is_number()) {
    number = static_cast<Number>(json.get<double>());
    if (!std::isfinite(number)) fail(json, "a number that the type can hold");
  } else if (json == "NaN") {
    number = std::numeric_limits<Number>::quiet_NaN();
  } else if (json == "Infinity") {
    number = std::numeric_limits<Number>::infinity();
  } else if (json == "-Infinity") {
    number = -std::numeric_limits<Number>::infinity();
  } else {
    if (!json.is_string()) fail(json, needed);
    const auto& text = json.get_ref<const std::string&>();
    Bits bits = 0;
    const char* const end = text.data() + text.size();
    if (text.size() != 2 + 2 * sizeof bits || !text.starts_with("0x")) fail(json, needed);
    const auto [stop, error] = std::from_chars(text.data() + 2, end, bits, 16);
    if (error != std::errc() || stop != end) fail(json, needed);
    std::memcpy(to, &bits, sizeof bits);
    return;
  }
  std::memcpy(to, &number, sizeof number);
}

void read_number(const FieldDescriptor& field, const Json& json, void* to) {
  switch (field.wire) {
    case Wire::int8: return read_integer<std::int8_t>(field, json, to);
    case Wire::uint8: return read_integer<std::uint8_t>(field, json, to);
    case Wire::int16: return read_integer<std::int16_t>(field, json, to);
    case Wire::uint16: return read_integer<std::uint16_t>(field, json, to);
    case Wire::int32: return read_integer<std::int32_t>(field, json, to);
    case Wire::uint32: return read_integer<std::uint32_t>(field, json, to);
    case Wire::int64: return read_integer<std::int64_t>(field, json, to);
    case Wire::uint64: return read_integer<std::uint64_t>(field, json, to);
    case Wire::fp32: return read_floating<float, std::uint32_t>(json, to);
    default: return read_floating<double, std::uint64_t>(json, to);
  }
}

void read_array(const FieldDescriptor& field, const Json& json, void* to) {
  auto* const bytes = static_cast<std::byte*>(to);
  if (field.digits && json.is_object() && json.contains("hex")) {
    Bytes read;
    read_hex(json["hex"], field.count, read);
    std::memcpy(to, read.data(), field.count);
    return;
  }
  if (field.digits) {
    const std::size_t places = field.count - 1;
    std::string digits = json.is_number_unsigned() ? std::to_string(json.get<std::uint64_t>()) : "";
    if (digits.empty() || digits.size() > places)
      fail(json, "an integer of at most " + std::to_string(places) + " digits");
    digits.insert(0, places - digits.size(), '0');
    std::memcpy(to, digits.c_str(), field.count);
    return;
  }
  if (!json.is_array() || json.size() != field.count)
    fail(json, "a list of " + std::to_string(field.count) + " numbers");
  for (std::size_t i = 0; i < json.size(); ++i) read_number(field, json[i], bytes + i * size_of(field.wire));
}

void read_inline(const MessageSet& set, const Json& json, InlineMessage& to, int depth) {
  to = {};
  if (json.is_null()) return;
  if (depth == max_nested) throw Wrong{"is nested deeper than " + std::to_string(max_nested) + " messages"};
  if (!json.is_object() || !json.contains("abbrev") || !json["abbrev"].is_string())
    fail(json, R"(null or {"abbrev": the name of a message, "fields": {...}})");
  const auto& name = json["abbrev"].get_ref<const std::string&>();
  const MessageDescriptor* const descriptor = set.find(std::string_view(name));
  if (descriptor == nullptr) {
    std::vector<std::string> names;
    for (const MessageDescriptor* m : set.messages) names.emplace_back(m->name);
    throw Wrong{"holds '" + name + "', which is no message of set " + std::string(set.name) +
                did_you_mean(name, names)};
  }
  Message message(*descriptor);
  if (json.contains("fields")) read_object(json["fields"], message, depth + 1);
  std::string why;
  if (!put_inline(message, to, &why)) throw Wrong{"can't be written: " + why};
}

void read_field(const MessageSet& set, const FieldDescriptor& field, const Json& json, void* to, int depth) {
  switch (field.wire) {
    case Wire::plaintext: {
      Bytes bytes;
      if (json.is_string()) {
        *static_cast<String*>(to) = std::string_view(json.get_ref<const std::string&>());
        return;
      }
      if (!json.is_object() || !json.contains("hex")) fail(json, R"(a string, or {"hex": its bytes})");
      read_hex(json["hex"], 0, bytes);
      *static_cast<String*>(to) = std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      return;
    }
    case Wire::rawdata:
    case Wire::rest: return read_hex(json, 0, *static_cast<Bytes*>(to));
    case Wire::message: return read_inline(set, json, *static_cast<InlineMessage*>(to), depth);
    case Wire::message_list: {
      auto& list = *static_cast<List*>(to);
      if (!json.is_array()) fail(json, "a list of messages");
      list.resize(json.size());
      for (std::size_t i = 0; i < json.size(); ++i) read_inline(set, json[i], list[i], depth);
      return;
    }
    default: return field.count > 0 ? read_array(field, json, to) : read_number(field, json, to);
  }
}

void read_object(const Json& object, Message& message, int depth) {
  const MessageDescriptor& descriptor = *message.descriptor();
  const std::string owner(descriptor.name);
  if (!object.is_object())
    throw Wrong{"the fields of " + owner + " are " + shown(object) + "; they need to be an object"};
  for (const auto& item : object.items()) {
    const std::string& name = item.key();
    const auto field =
        std::find_if(descriptor.fields.begin(), descriptor.fields.end(), [&](const auto& f) { return f.name == name; });
    if (field == descriptor.fields.end()) {
      std::vector<std::string> names;
      for (const FieldDescriptor& f : descriptor.fields) names.emplace_back(f.name);
      throw Wrong{owner + " has no field '" + name + "'" + did_you_mean(name, names) + "; it has: " + list_of(names)};
    }
    try {
      read_field(descriptor.set(), *field, item.value(), static_cast<std::byte*>(message.value()) + field->offset,
                 depth);
    } catch (const Wrong& wrong) { throw Wrong{"field '" + name + "' of " + owner + " " + wrong.text}; }
  }
}

}  // namespace

bool from_json(std::string_view object, Message& message, std::string& why) {
  try {
    read_object(Json::parse(object), message, 0);
    return true;
  } catch (const Wrong& wrong) { why = wrong.text; } catch (const Json::exception& error) {
    why = "is no JSON object";
  }
  return false;
}

}  // namespace jarol::messages
