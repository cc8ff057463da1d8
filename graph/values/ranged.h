// Which fields may have a range, and what its ends may be; looked at when a description is compiled.
#pragma once

#include <chrono>
#include <concepts>
#include <type_traits>

#include "graph/values/field_range.h"

namespace jarol::detail {

// What a range of such a value is about: the value itself, or the elements of an array, a sequence or a vector.
template <class T>
struct Ranged {
  using Number = T;
};
template <class T>
requires requires { typename T::value_type; }
struct Ranged<T> : Ranged<typename T::value_type> {};

// As which its ends are written.
template <class T>
using BoundOf = std::conditional_t<std::same_as<typename Ranged<T>::Number, std::chrono::nanoseconds>,
                                   std::chrono::nanoseconds, double>;

constexpr double number_of(double bound) { return bound; }
constexpr double number_of(std::chrono::nanoseconds bound) { return static_cast<double>(bound.count()); }

// Called where a constant is asked for, so that the compiler's error has their names.
inline void the_first_end_of_a_range_is_above_the_second() {}
inline void a_range_of_whole_numbers_has_whole_ends_up_to_2_to_the_53() {}
inline void a_range_has_finite_ends() {}

template <class T>
consteval FieldRange range_of(BoundOf<T> min, BoundOf<T> max) {
  using Number = typename Ranged<T>::Number;
  static_assert((std::is_arithmetic_v<Number> && !std::same_as<Number, bool> && !std::same_as<Number, char>) ||
                    std::same_as<Number, std::chrono::nanoseconds>,
                "a range is of numbers and durations, and of arrays and sequences of these");
  FieldRange range{number_of(min), number_of(max)};
  if (!(range.min <= range.max)) the_first_end_of_a_range_is_above_the_second();
  constexpr double infinity = std::numeric_limits<double>::infinity(), exact = 9007199254740992;
  for (const double end : {range.min, range.max}) {
    if (end == infinity || end == -infinity) a_range_has_finite_ends();
    if constexpr (!std::floating_point<Number>)
      if (!(end >= -exact && end <= exact) || end != static_cast<double>(static_cast<long long>(end)))
        a_range_of_whole_numbers_has_whole_ends_up_to_2_to_the_53();
  }
  // the float that is nearest to an end belongs to it
  if constexpr (std::same_as<Number, float>)
    range = {static_cast<double>(static_cast<float>(range.min)), static_cast<double>(static_cast<float>(range.max))};
  return range;
}

}  // namespace jarol::detail
