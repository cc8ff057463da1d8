// What values are made of: which of them have elements, and which change their size.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <concepts>
#include <tuple>
#include <type_traits>

#include "graph/values/describe.h"
#include "graph/values/duration.h"
#include "graph/values/sequence.h"

namespace jarol {

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

}  // namespace detail
}  // namespace jarol
