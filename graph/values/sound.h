// Is a value sound: are its numbers finite, and in the ranges that their fields declare?
#pragma once

#include <bit>
#include <cstdint>
#include <utility>

#include "graph/values/parts.h"

namespace jarol::detail {

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
    return with_fields(T::fields(),
                       [&](auto... f) { return (std::uint64_t{0} | ... | any_non_finite(value.*(f.pointer))); });
  } else {
    return 0;
  }
}

template <class T>
inline bool has_non_finite(const T& value) {
  return (any_non_finite(value) >> 63) != 0;
}

// Does anything in it declare a range?
template <class T>
constexpr bool has_ranges() {
  if constexpr (Array<T>) {
    return has_ranges<typename ArrayTraits<T>::Element>();
  } else if constexpr (SequenceOf<T>) {
    return has_ranges<typename SequenceTraits<T>::Element>();
  } else if constexpr (Described<T>) {
    return with_fields(T::fields(), [](auto... f) {
      return ((f.range.is_stated() || has_ranges<typename decltype(f)::Value>()) || ...);
    });
  } else {
    return false;
  }
}

template <class T>
constexpr bool is_in(const FieldRange& range, const T& value) {
  if constexpr (Array<T>) {
    for (std::size_t i = 0; i < ArrayTraits<T>::count; ++i)
      if (!is_in(range, value[i])) return false;
    return true;
  } else if constexpr (SequenceOf<T>) {
    for (const auto& element : value)
      if (!is_in(range, element)) return false;
    return true;
  } else if constexpr (std::same_as<T, Duration>) {
    return range.has(static_cast<double>(value.count()));
  } else {
    return range.has(static_cast<double>(value));
  }
}

// Whatever declares nothing is not looked at.
template <class T>
constexpr bool is_in_range(const T& value) {
  if constexpr (!has_ranges<T>()) {
    return true;
  } else if constexpr (Array<T>) {
    for (std::size_t i = 0; i < ArrayTraits<T>::count; ++i)
      if (!is_in_range(value[i])) return false;
    return true;
  } else if constexpr (SequenceOf<T>) {
    for (const auto& element : value)
      if (!is_in_range(element)) return false;
    return true;
  } else {
    return [&]<auto... Member>(FieldList<Member...>*) {
      const auto field_is_in = [&]<auto One>(Field<One>*) {
        constexpr Field<One> field = T::fields();
        const auto& member = value.*(field.pointer);
        if constexpr (field.range.is_stated()) {
          if (!is_in(field.range, member)) return false;
        }
        return is_in_range(member);
      };
      return (field_is_in(static_cast<Field<Member>*>(nullptr)) && ...);
    }
    (static_cast<decltype(T::fields())*>(nullptr));
  }
}

}  // namespace jarol::detail
