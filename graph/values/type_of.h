// type_of<T>(): the runtime description of a C++ value type, made once from its static description.
#pragma once

#include <array>
#include <cstring>
#include <memory_resource>
#include <new>
#include <type_traits>

#include "graph/values/parts.h"
#include "graph/values/sound.h"
#include "graph/values/type.h"
#include "graph/values/words.h"

namespace jarol {
namespace detail {

template <class T>
void adopt(T& value, std::pmr::memory_resource* memory) {
  if constexpr (SequenceOf<T> || std::same_as<T, String>) {
    value.adopt(memory);
  } else if constexpr (is_deep<T>()) {
    if constexpr (Array<T>) {
      for (auto& element : value) adopt(element, memory);
    } else {
      with_described(value, [&](auto&... member) { (adopt(member, memory), ...); });
    }
  }
}

template <class T>
concept has_constant_default = requires {
  typename std::bool_constant<(static_cast<void>(T{}), true)>;
};

template <class T>
Type make_type();
template <class T>
void fill_type(Type& type);

}  // namespace detail

template <class T>
const Type& type_of() {
  static const Type type = detail::make_type<T>();
  return type;
}

namespace detail {

// Has it enumerators, each with a name of its own? Those that are not known to the compiler are not asked.
template <class E>
constexpr bool has_distinct_names() {
  if constexpr (requires { typename std::bool_constant<(static_cast<void>(enumerators(E{})), true)>; }) {
    constexpr auto all = enumerators(E{});
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (all[i].name == all[j].name) return false;
    return all.size() > 0;
  }
  return true;
}

template <class T>
constexpr std::string_view scalar_name() {
  if constexpr (std::same_as<T, double>) return "double";
  if constexpr (std::same_as<T, float>) return "float";
  if constexpr (std::same_as<T, bool>) return "bool";
  if constexpr (std::same_as<T, Duration>) return "duration";
  constexpr bool is_signed = std::is_signed_v<T>;
  if constexpr (sizeof(T) == 1) return is_signed ? "int8" : "uint8";
  if constexpr (sizeof(T) == 2) return is_signed ? "int16" : "uint16";
  if constexpr (sizeof(T) == 4) return is_signed ? "int32" : "uint32";
  if constexpr (sizeof(T) == 8) return is_signed ? "int64" : "uint64";
}

// What a struct's fields() says, as a table that the compiler makes.
template <class T>
inline constexpr auto described_fields = with_fields(T::fields(), [](auto... f) {
  return std::array<DescribedField, sizeof...(f)>{
      {{f.name, f.unit, f.text, f.range, &type_of<typename decltype(f)::Value>}...}};
});

template <class T>
void set_length_operations(Type& type) {
  type.capacity = [](const void* value) { return static_cast<const T*>(value)->capacity(); };
  type.lie_in = [](void* value, std::pmr::memory_resource* memory, void* elements, std::size_t length,
                   std::size_t capacity) { static_cast<T*>(value)->lie_in(memory, elements, length, capacity); };
  type.length = [](const void* value) { return static_cast<const T*>(value)->size(); };
  if constexpr (SequenceOf<T>) {
    type.elements = [](const void* value) -> const void* { return static_cast<const T*>(value)->data(); };
    type.resize = [](void* value, std::size_t length) -> void* {
      static_cast<T*>(value)->resize(length);
      return static_cast<T*>(value)->data();
    };
  } else {
    type.elements = [](const void* value) -> const void* { return static_cast<const T*>(value)->view().data(); };
    type.resize = [](void* value, std::size_t length) -> void* { return static_cast<T*>(value)->resize(length); };
  }
}

template <auto Member, class T = Innermost<typename Field<Member>::Value>>
constexpr bool has_names() {
  if constexpr (!asks_for_names_at_once)
    static_assert(!std::is_enum_v<T> || DescribedEnum<T>, "an enumeration within a value needs enumerators(E)");
  return !std::is_enum_v<T> || DescribedEnum<T>;
}

// False if a field has been rejected: then no more errors follow from it.
template <class T>
constexpr bool is_well_described() {
  if constexpr (Described<T>) {
    return []<auto... Member>(FieldList<Member...>*) {
      return ((is_value<typename Field<Member>::Value> && has_names<Member>()) && ...);
    }
    (field_types<T>);
  } else {
    return true;
  }
}

template <class T>
Type make_type() {
  static_assert(is_value<T>,
                "a struct is a value once it has a public static constexpr auto fields() { return "
                "jarol::describe(jarol::field<&Struct::member>(), ...); }, with all its members");
  Type type;
  if constexpr (is_value<T> && is_well_described<T>()) fill_type<T>(type);
  return type;
}

template <class T>
void fill_type(Type& type) {
  type.size = sizeof(T);
  type.alignment = alignof(T);
  type.construct = [](void* to) {
    std::memset(to, 0, sizeof(T));  // padding too, so that equal values are equal bytes
    new (to) T{};
  };
  type.finite = [](const void* value) { return !has_non_finite(*static_cast<const T*>(value)); };
  if constexpr (has_ranges<T>())
    type.in_range = [](const void* value) { return is_in_range(*static_cast<const T*>(value)); };
  type.hash_words = [](const void* value) { return hash_words(*static_cast<const T*>(value)); };
  if constexpr (is_deep<T>()) {
    type.adopt = [](void* value, std::pmr::memory_resource* memory) { adopt(*static_cast<T*>(value), memory); };
    type.assign = [](void* to, const void* from) { *static_cast<T*>(to) = *static_cast<const T*>(from); };
    type.destroy = [](void* value) { std::destroy_at(static_cast<T*>(value)); };
  }
  if constexpr (SequenceOf<T> || std::same_as<T, String>) set_length_operations<T>(type);
  if constexpr (std::same_as<T, bool> || std::floating_point<T> || Integer<T> || std::same_as<T, Duration>) {
    type.name = scalar_name<T>();
    type.kind = std::same_as<T, bool>       ? Kind::boolean
                : std::floating_point<T>    ? Kind::floating
                : std::same_as<T, Duration> ? Kind::duration
                : std::is_signed_v<T>       ? Kind::signed_integer
                                            : Kind::unsigned_integer;
  } else if constexpr (std::is_enum_v<T>) {
    static_assert(DescribedEnum<T>, "an enumeration is a value once enumerators(E) lists its names");
    static_assert(has_distinct_names<T>(), "enumerators(E) lists one at least, and each by a name of its own");
    type.name = type_name<T>();
    type.kind = Kind::enumeration;
    for (const auto& e : enumerators(T{})) {
      type.enumerators.emplace_back(e.name, static_cast<std::int64_t>(e.value));
      type.meanings.emplace_back(e.meaning);
    }
  } else if constexpr (Array<T>) {
    type.element = &type_of<typename ArrayTraits<T>::Element>();
    type.count = ArrayTraits<T>::count;
    type.kind = Kind::array;
    type.name = type.element->name + "[" + std::to_string(type.count) + "]";
  } else if constexpr (SequenceOf<T>) {
    type.element = &type_of<typename SequenceTraits<T>::Element>();
    type.kind = Kind::sequence;
    type.name = type.element->name + "[]";
  } else if constexpr (std::same_as<T, String>) {
    type.kind = Kind::string;
    type.name = "string";
  } else {
    static_assert(std::is_aggregate_v<T>, "a value is a plain struct without constructors or private members");
    static_assert(decltype(T::fields())::count > 0 || member_count<T>() == 0,
                  "fields() must describe every member of the struct; it describes none");
    if constexpr (has_ranges<T>() && has_constant_default<T>)
      static_assert(is_in_range(T{}), "a default value is outside the range of its field");
    type.name = type_name<T>();
    type.kind = Kind::structure;
    [&]<auto... Member>(FieldList<Member...>*) {
      static constexpr std::array<const void*, sizeof...(Member)> members{&(place<T>.value.*Member)...};
      add_fields(type, described_fields<T>, &place<T>.value, members.data());
    }
    (field_types<T>);
  }
}

}  // namespace detail
}  // namespace jarol
