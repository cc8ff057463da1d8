#include "distributers/messages/limits.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "distributers/messages/payload.h"
#include "graph/language/quantities.h"

namespace jarol::messages {
namespace {

// Where two numbers of the field's type stand to one another; nothing if the limit is no number.
template <class Number>
std::optional<Number> limit_of(std::string_view text) {
  // a limit that a 32-bit field can't hold is meant as the nearest that it can, as with pi
  using Read = std::conditional_t<std::is_floating_point_v<Number>, double, Number>;
  Read value{};
  const bool hex = text.starts_with("0x");
  const char *const begin = text.data() + (hex ? 2 : 0), *const end = text.data() + text.size();
  std::from_chars_result result{};
  if constexpr (std::is_floating_point_v<Number>)
    result = std::from_chars(begin, end, value);
  else
    result = std::from_chars(begin, end, value, hex ? 16 : 10);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return static_cast<Number>(value);
}

std::string text_of(double number) { return number_text(number); }
std::string text_of(float number) { return number_text(number); }
template <class Integer>
std::string text_of(Integer integer) {
  return std::to_string(integer);
}

class Finder {
 public:
  void look_at(MessageRef message, const std::string& before) {
    for (const FieldDescriptor& field : message.descriptor->fields) {
      const auto* const value = static_cast<const std::byte*>(message.value) + field.offset;
      const std::string path = before + std::string(field.name);
      const MessageSet& set = message.descriptor->set();
      if (field.wire == Wire::message) look_inside(set, *reinterpret_cast<const InlineMessage*>(value), path);
      if (field.wire == Wire::message_list) {
        const auto& list = *reinterpret_cast<const Sequence<InlineMessage>*>(value);
        for (std::size_t i = 0; i < list.size(); ++i) look_inside(set, list[i], path + "[" + std::to_string(i) + "]");
      }
      if (field.min.empty() && field.max.empty()) continue;
      for (std::size_t i = 0; i < std::max(field.count, 1U); ++i)
        look_at_number(field, value + i * size_of(field.wire),
                       field.count > 0 ? path + "[" + std::to_string(i) + "]" : path);
    }
  }

  std::vector<std::string> found;

 private:
  void look_inside(const MessageSet& set, const InlineMessage& from, const std::string& path) {
    Message message;
    if (!from.empty() && take_inline(set, from, message)) look_at(message, path + ".");
  }

  void look_at_number(const FieldDescriptor& field, const std::byte* value, const std::string& path) {
    switch (field.wire) {
      case Wire::int8: return compare<std::int8_t>(field, value, path);
      case Wire::uint8: return compare<std::uint8_t>(field, value, path);
      case Wire::int16: return compare<std::int16_t>(field, value, path);
      case Wire::uint16: return compare<std::uint16_t>(field, value, path);
      case Wire::int32: return compare<std::int32_t>(field, value, path);
      case Wire::uint32: return compare<std::uint32_t>(field, value, path);
      case Wire::int64: return compare<std::int64_t>(field, value, path);
      case Wire::uint64: return compare<std::uint64_t>(field, value, path);
      case Wire::fp32: return compare<float>(field, value, path);
      case Wire::fp64: return compare<double>(field, value, path);
      case Wire::plaintext:
      case Wire::rawdata:
      case Wire::rest:
      case Wire::message:
      case Wire::message_list: break;
    }
  }

  template <class Number>
  void compare(const FieldDescriptor& field, const std::byte* from, const std::string& path) {
    Number number;
    std::memcpy(&number, from, sizeof number);
    const std::optional<Number> min = limit_of<Number>(field.min), max = limit_of<Number>(field.max);
    if (min && number < *min) found.push_back(path + ": " + text_of(number) + " is below " + std::string(field.min));
    if (max && number > *max) found.push_back(path + ": " + text_of(number) + " is above " + std::string(field.max));
  }
};

}  // namespace

std::vector<std::string> find_outside(MessageRef message) {
  Finder finder;
  finder.look_at(message, "");
  return finder.found;
}

}  // namespace jarol::messages
