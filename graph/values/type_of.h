// type_of<T>(): the runtime description of a C++ value type, made once from its static description.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstring>
#include <new>
#include <type_traits>

#include "graph/values/describe.h"
#include "graph/values/digest.h"
#include "graph/values/sequence.h"
#include "graph/values/type.h"

namespace jarol {

using Duration = std::chrono::nanoseconds;

namespace detail {

template <class T>
struct ArrayTraits {
  static constexpr bool is_array = false;
};
template <class E, std::size_t N>
struct ArrayTraits<std::array<E, N>> {
  static constexpr bool is_array = true;
  static constexpr std::size_t count = N;
  using Element = E;
};
template <class E, int Rows, int Options>
struct ArrayTraits<Eigen::Matrix<E, Rows, 1, Options, Rows, 1>> {
  static constexpr bool is_array = Rows > 0;
  static constexpr std::size_t count = Rows > 0 ? Rows : 0;
  using Element = E;
};

template <class T>
struct SequenceTraits {
  static constexpr bool is_sequence = false;
};
template <class E>
struct SequenceTraits<Sequence<E>> {
  static constexpr bool is_sequence = true;
  using Element = E;
};

template <class T>
concept Integer = std::integral<T> && !std::same_as<T, bool> && !std::same_as<T, char>;

template <class T>
concept Array = ArrayTraits<T>::is_array;

template <class T>
concept SequenceOf = SequenceTraits<T>::is_sequence;

// Does it hold anything of changing size?
template <class T>
constexpr bool is_deep() {
  if constexpr (SequenceOf<T> || std::same_as<T, String>) {
    return true;
  } else if constexpr (Array<T>) {
    return is_deep<typename ArrayTraits<T>::Element>();
  } else if constexpr (Described<T>) {
    return std::apply([](auto... f) { return (is_deep<typename decltype(f)::Value>() || ...); }, T::fields());
  } else {
    return false;
  }
}

template <class T>
void adopt(T& value, std::pmr::memory_resource* memory) {
  if constexpr (SequenceOf<T> || std::same_as<T, String>) {
    value.adopt(memory);
  } else if constexpr (is_deep<T>()) {
    if constexpr (Array<T>) {
      for (auto& element : value) adopt(element, memory);
    } else {
      std::apply([&](auto... f) { (adopt(value.*(f.pointer), memory), ...); }, T::fields());
    }
  }
}

// Eight bytes a word, the first in the lowest place.
template <class Visit>
inline void for_each_packed_word(std::string_view text, Visit&& visit) {
  for (std::size_t i = 0; i < text.size(); i += 8) {
    std::uint64_t word = 0;
    for (std::size_t b = 0; b < 8 && i + b < text.size(); ++b)
      word |= std::uint64_t{static_cast<unsigned char>(text[i + b])} << (8 * b);
    visit(word);
  }
}

// Calls visit(word) for each word of the value, in the order of its description.
template <class T, class Visit>
inline void for_each_word(const T& value, Visit&& visit) {
  if constexpr (std::same_as<T, double>) {
    visit(std::bit_cast<std::uint64_t>(value));
  } else if constexpr (std::same_as<T, float>) {
    visit(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(value)));
  } else if constexpr (std::same_as<T, bool>) {
    visit(static_cast<std::uint64_t>(value));
  } else if constexpr (std::is_enum_v<T>) {
    visit(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
  } else if constexpr (Integer<T>) {
    visit(static_cast<std::uint64_t>(value));  // sign extension gives two's complement of 64 bits
  } else if constexpr (std::same_as<T, Duration>) {
    visit(static_cast<std::uint64_t>(value.count()));
  } else if constexpr (Array<T>) {
    for (std::size_t i = 0; i < ArrayTraits<T>::count; ++i) for_each_word(value[i], visit);
  } else if constexpr (SequenceOf<T>) {
    visit(static_cast<std::uint64_t>(value.size()));
    for (const auto& element : value) for_each_word(element, visit);
  } else if constexpr (std::same_as<T, String>) {
    visit(static_cast<std::uint64_t>(value.size()));
    for_each_packed_word(value.view(), visit);
  } else {
    std::apply([&](auto... f) { (for_each_word(value.*(f.pointer), visit), ...); }, T::fields());
  }
}

// Top bit set for an exponent of all ones, which is an infinity or a NaN: one more carries into the sign. On integers,
// one by one: a vector load over what a task has just stored word by word would wait for the stores.
inline std::uint64_t non_finite(double x) {
  auto bits = std::bit_cast<std::uint64_t>(x);
  asm("" : "+r"(bits));
  return (bits & 0x7ff0000000000000ULL) + 0x0010000000000000ULL;
}
inline std::uint64_t non_finite(float x) {
  return std::uint64_t{(std::bit_cast<std::uint32_t>(x) & 0x7f800000U) + 0x00800000U} << 32;
}

template <class T>
inline std::uint64_t any_non_finite(const T& value) {
  if constexpr (std::floating_point<T>) {
    return non_finite(value);
  } else if constexpr (Array<T>) {
    std::uint64_t any = 0;
    for (std::size_t i = 0; i < ArrayTraits<T>::count; ++i) any |= any_non_finite(value[i]);
    return any;
  } else if constexpr (SequenceOf<T>) {
    std::uint64_t any = 0;
    if constexpr (std::same_as<T, Sequence<double>>) {
      // long enough that vectors pay
      for (const double x : value)
        any |= (std::bit_cast<std::uint64_t>(x) & 0x7ff0000000000000ULL) + 0x0010000000000000ULL;
    } else {
      for (const auto& element : value) any |= any_non_finite(element);
    }
    return any;
  } else if constexpr (Described<T>) {
    return std::apply([&](auto... f) { return (std::uint64_t{0} | ... | any_non_finite(value.*(f.pointer))); },
                      T::fields());
  } else {
    return 0;
  }
}

template <class T>
inline bool has_non_finite(const T& value) {
  return (any_non_finite(value) >> 63) != 0;
}

template <class T>
inline std::uint64_t hash_words(const T& value) {
  digest::Words words;
  for_each_word(value, [&](std::uint64_t word) { words.add(word); });
  return words.sum();
}

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

// A default value, for the places of its members.
template <class T>
const T& example() {
  alignas(T) static std::byte memory[sizeof(T)];
  static const T* const value = new (memory) T{};
  return *value;
}

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

template <class T>
inline constexpr bool is_value = Described<T> || DescribedEnum<T> || std::is_arithmetic_v<T> ||
                                 std::same_as<T, Duration> || std::same_as<T, String> || SequenceOf<T> || Array<T>;

template <auto Member, class T>
constexpr bool require_description() {
  static_assert(is_value<T> || has_substitute<T>,
                "a struct within a value needs a fields() of its own, an enumeration enumerators(E)");
  return is_value<T>;
}

// False if something in the description has been rejected: then no more errors follow from it.
template <class T>
constexpr bool is_well_described() {
  if constexpr (Described<T>) {
    return []<auto... Member>(std::tuple<Field<Member>...>*) {
      return (require_description<Member, typename Field<Member>::Value>() && ...);
    }
    (static_cast<decltype(T::fields())*>(nullptr));
  } else {
    return true;
  }
}

template <class T>
Type make_type() {
  Type type;
  if constexpr (is_well_described<T>()) fill_type<T>(type);
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
    static_assert(Described<T>, "a struct is a value once its fields() describes every member");
    static_assert(std::is_aggregate_v<T>, "a value is a plain struct without constructors or private members");
    static_assert(std::tuple_size_v<decltype(T::fields())> > 0 || member_count<T>() == 0,
                  "fields() must describe every member of the struct; it describes none");
    type.name = type_name<T>();
    type.kind = Kind::structure;
    const T& value = example<T>();
    std::apply(
        [&](auto... f) {
          (add_field(type, f.name, f.unit, f.text, &value, &(value.*(f.pointer)),
                     type_of<typename decltype(f)::Value>()),
           ...);
        },
        T::fields());
  }
}

}  // namespace detail
}  // namespace jarol
