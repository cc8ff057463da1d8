// Is a value sound: are its numbers finite, and in the ranges that their fields declare?
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

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

// How many doubles it is made of, and of nothing else; 0: it is not.
template <class T>
constexpr std::size_t doubles_in() {
  std::size_t count = 0;
  if constexpr (std::same_as<T, double>) {
    count = 1;
  } else if constexpr (Array<T>) {
    count = ArrayTraits<T>::count * doubles_in<typename ArrayTraits<T>::Element>();
  } else if constexpr (!SequenceOf<T> && Described<T>) {
    count = []<auto... Member>(FieldList<Member...>*) {
      return (std::size_t{0} + ... + doubles_in<typename Field<Member>::Value>());
    }
    (field_types<T>);
  }
  return sizeof(T) == count * sizeof(double) ? count : 0;
}

#ifdef __SSE2__
// The same of many, by twos: each number is loaded by itself, as above.
template <std::size_t Count>
[[gnu::always_inline]] inline std::uint64_t any_non_finite(const double* numbers) {
  const __m128i exponent = _mm_set1_epi64x(0x7ff0000000000000LL), one_more = _mm_set1_epi64x(0x0010000000000000LL);
  const auto sign_of = [&](__m128d two) {
    return _mm_add_epi64(_mm_and_si128(_mm_castpd_si128(two), exponent), one_more);
  };
  __m128i any = _mm_setzero_si128();
  for (std::size_t i = 0; i + 1 < Count; i += 2) {
    __m128d two = _mm_load_sd(numbers + i);
    asm("" : "+x"(two));
    any = _mm_or_si128(any, sign_of(_mm_loadh_pd(two, numbers + i + 1)));
  }
  if constexpr (Count % 2 != 0) any = _mm_or_si128(any, sign_of(_mm_load_sd(numbers + Count - 1)));
  any = _mm_or_si128(any, _mm_unpackhi_epi64(any, any));
  return static_cast<std::uint64_t>(_mm_cvtsi128_si64(any));
}
constexpr std::size_t many = 4;
#endif

template <class T>
inline std::uint64_t any_non_finite(const T& value) {
#ifdef __SSE2__
  if constexpr (doubles_in<T>() >= many)
    return any_non_finite<doubles_in<T>()>(reinterpret_cast<const double*>(&value));
#endif
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
    return with_described(value,
                          [](const auto&... member) { return (std::uint64_t{0} | ... | any_non_finite(member)); });
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
    (field_types<T>);
  }
}

}  // namespace jarol::detail
