#include "graph/values/pack.h"

#include <cstring>

namespace jarol {
namespace {

const Type& byte_type() {
  static const Type type = [] {
    Type made;
    made.size = 1;
    return made;
  }();
  return type;
}

const Type& element_of(const Type& type) { return type.kind == Kind::string ? byte_type() : *type.element; }

// Calls visit(part type, offset) for each member or element of fixed place.
template <class Visit>
void for_each_part(const Type& type, Visit&& visit) {
  for (const TypeField& f : type.fields) visit(*f.type, f.offset);
  for (std::size_t i = 0; type.kind == Kind::array && i < type.count; ++i) visit(*type.element, i * type.element->size);
}

bool has_length(const Type& type) { return type.length != nullptr; }

}  // namespace

std::size_t packed_size(const Type& type, const void* value) {
  if (!type.is_deep()) return type.size;
  const auto* bytes = static_cast<const std::byte*>(value);
  std::size_t size = 0;
  if (!has_length(type)) {
    for_each_part(type, [&](const Type& part, std::size_t offset) { size += packed_size(part, bytes + offset); });
    return size;
  }
  const Type& element = element_of(type);
  const std::size_t length = type.length(value);
  size = sizeof(std::uint64_t);
  if (!element.is_deep()) return size + length * element.size;
  const auto* elements = static_cast<const std::byte*>(type.elements(value));
  for (std::size_t i = 0; i < length; ++i) size += packed_size(element, elements + i * element.size);
  return size;
}

std::byte* pack(const Type& type, const void* value, std::byte* to) {
  const auto* bytes = static_cast<const std::byte*>(value);
  if (!type.is_deep()) {
    std::memcpy(to, bytes, type.size);
    return to + type.size;
  }
  if (!has_length(type)) {
    for_each_part(type, [&](const Type& part, std::size_t offset) { to = pack(part, bytes + offset, to); });
    return to;
  }
  const Type& element = element_of(type);
  const std::uint64_t length = type.length(value);
  std::memcpy(to, &length, sizeof length);
  to += sizeof length;
  const auto* elements = static_cast<const std::byte*>(type.elements(value));
  if (!element.is_deep()) {
    if (length > 0) std::memcpy(to, elements, length * element.size);
    return to + length * element.size;
  }
  for (std::size_t i = 0; i < length; ++i) to = pack(element, elements + i * element.size, to);
  return to;
}

namespace {

// Looks through packed bytes from `at` on, and moves it behind the value.
std::string wrong_from(const Type& type, std::span<const std::byte> packed, std::size_t& at) {
  const std::size_t left = packed.size() - at;
  if (!type.is_deep() && left < type.size) return "ends before its bytes do";
  if (type.kind == Kind::boolean) {
    const auto byte = std::to_integer<unsigned>(packed[at++]);
    return byte > 1 ? "has " + std::to_string(byte) + " where true or false stand" : "";
  }
  if (!has_length(type)) {
    const std::size_t begin = at;
    std::string wrong;
    for_each_part(type, [&](const Type& part, std::size_t offset) {
      if (!type.is_deep()) at = begin + offset;  // as in memory, with room between
      if (wrong.empty()) wrong = wrong_from(part, packed, at);
    });
    if (!type.is_deep()) at = begin + type.size;
    return wrong;
  }
  std::uint64_t length = 0;
  if (left < sizeof length) return "ends before its length";
  std::memcpy(&length, packed.data() + at, sizeof length);
  at += sizeof length;
  const Type& element = element_of(type);
  const std::size_t size = element.is_deep() ? sizeof length : element.size;
  if (length > (packed.size() - at) / size) return "has a length of " + std::to_string(length) + " and fewer bytes";
  for (std::uint64_t i = 0; i < length; ++i)
    if (const std::string wrong = wrong_from(element, packed, at); !wrong.empty()) return wrong;
  return "";
}

}  // namespace

std::string wrong_packed_begin(const Type& type, std::span<const std::byte> packed, std::size_t& size) {
  size = 0;
  return wrong_from(type, packed, size);
}

std::string wrong_packed(const Type& type, std::span<const std::byte> packed) {
  std::size_t at = 0;
  const std::string wrong = wrong_packed_begin(type, packed, at);
  if (!wrong.empty() || at == packed.size()) return wrong;
  return "ends " + std::to_string(packed.size() - at) + " bytes before they do";
}

const std::byte* unpack(const Type& type, const std::byte* from, void* value) {
  auto* bytes = static_cast<std::byte*>(value);
  if (!type.is_deep()) {
    std::memcpy(bytes, from, type.size);
    return from + type.size;
  }
  if (!has_length(type)) {
    for_each_part(type, [&](const Type& part, std::size_t offset) { from = unpack(part, from, bytes + offset); });
    return from;
  }
  const Type& element = element_of(type);
  std::uint64_t length = 0;
  std::memcpy(&length, from, sizeof length);
  from += sizeof length;
  auto* elements = static_cast<std::byte*>(type.resize(value, length));
  if (!element.is_deep()) {
    if (length > 0) std::memcpy(elements, from, length * element.size);
    return from + length * element.size;
  }
  for (std::size_t i = 0; i < length; ++i) from = unpack(element, from, elements + i * element.size);
  return from;
}

}  // namespace jarol
