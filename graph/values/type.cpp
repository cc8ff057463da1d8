#include "graph/values/type.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string_view>

namespace jarol {
namespace {

template <class T>
T load(const void* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

template <class T>
void store(void* to, T value) {
  std::memcpy(to, &value, sizeof(T));
}

bool is_signed(const Type& type) { return type.kind != Kind::unsigned_integer && type.kind != Kind::boolean; }

}  // namespace

bool same_type(const Type& a, const Type& b) {
  if (&a == &b) return true;
  if (a.name != b.name || a.kind != b.kind || a.size != b.size || a.count != b.count || a.enumerators != b.enumerators)
    return false;
  if (a.fields.size() != b.fields.size()) return false;
  for (std::size_t i = 0; i < a.fields.size(); ++i) {
    const TypeField &f = a.fields[i], &g = b.fields[i];
    if (f.name != g.name || f.unit != g.unit || f.offset != g.offset || !same_type(*f.type, *g.type)) return false;
  }
  return a.element == nullptr || same_type(*a.element, *b.element);
}

bool is_made_of_doubles(const Type& type) {
  if (type.kind == Kind::floating) return type.size == sizeof(double);
  if (type.kind == Kind::array) return type.count > 0 && is_made_of_doubles(*type.element);
  if (type.kind != Kind::structure || type.fields.empty()) return false;
  std::size_t size = 0;
  for (const TypeField& f : type.fields) {
    if (!is_made_of_doubles(*f.type)) return false;
    size += f.type->size;
  }
  return size == type.size;
}

bool has_floating(const Type& type) {
  if (type.element != nullptr) return has_floating(*type.element);
  return type.kind == Kind::floating ||
         std::any_of(type.fields.begin(), type.fields.end(), [](const TypeField& f) { return has_floating(*f.type); });
}

void copy_value(const Type& type, void* to, const void* from) {
  if (type.is_deep()) return type.assign(to, from);
  std::memcpy(to, from, type.size);
}

void add_fields(Type& structure, std::span<const DescribedField> fields, const void* value,
                const void* const* members) {
  structure.fields.reserve(fields.size());
  for (const DescribedField& f : fields) {
    const auto offset = static_cast<const std::byte*>(*members++) - static_cast<const std::byte*>(value);
    structure.fields.push_back({std::string(f.name), std::string(f.unit), std::string(f.text),
                                static_cast<std::size_t>(offset), &f.type(), f.range});
  }
}

const TypeField* find_field(const Type& type, std::string_view name) {
  for (const TypeField& f : type.fields)
    if (f.name == name) return &f;
  return nullptr;
}

std::int64_t read_integer(const Type& type, const void* value) {
  switch (type.size) {
    case 1: return is_signed(type) ? load<std::int8_t>(value) : load<std::uint8_t>(value);
    case 2: return is_signed(type) ? load<std::int16_t>(value) : load<std::uint16_t>(value);
    case 4: return is_signed(type) ? load<std::int32_t>(value) : static_cast<std::int64_t>(load<std::uint32_t>(value));
    default: assert(type.size == 8); return load<std::int64_t>(value);
  }
}

void write_integer(const Type& type, void* value, std::int64_t integer) {
  switch (type.size) {
    case 1: return store(value, static_cast<std::uint8_t>(integer));
    case 2: return store(value, static_cast<std::uint16_t>(integer));
    case 4: return store(value, static_cast<std::uint32_t>(integer));
    default: assert(type.size == 8); return store(value, integer);
  }
}

std::string_view read_string(const Type& type, const void* value) {
  return {static_cast<const char*>(type.elements(value)), type.length(value)};
}

void write_string(const Type& type, void* value, std::string_view text) {
  void* const bytes = type.resize(value, text.size());
  if (!text.empty()) std::memcpy(bytes, text.data(), text.size());
}

double read_ranged(const Type& type, const void* value) {
  if (type.kind == Kind::floating) return read_floating(type, value);
  const std::int64_t integer = read_integer(type, value);
  return type.kind == Kind::unsigned_integer ? static_cast<double>(static_cast<std::uint64_t>(integer))
                                             : static_cast<double>(integer);
}

double read_floating(const Type& type, const void* value) {
  return type.size == 4 ? load<float>(value) : load<double>(value);
}

void write_floating(const Type& type, void* value, double number) {
  if (type.size == 4) return store(value, static_cast<float>(number));
  store(value, number);
}

}  // namespace jarol
