// Which values are numbers, and which have elements.
#pragma once

#include <array>
#include <concepts>
#include <type_traits>

#include "graph/language/duration.h"
#include "graph/values/sequence.h"

// Whoever has one in a value includes Eigen; others need not wait for their compiler to read it.
namespace Eigen {
template <class Scalar, int Rows, int Columns, int Options, int MaxRows, int MaxColumns>
class Matrix;
template <class Derived>
struct EigenBase;
}  // namespace Eigen

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

// Their sign or size is another one on another platform, or they are texts.
template <class T>
concept Character = std::same_as<T, char> || std::same_as<T, wchar_t> || std::same_as<T, char8_t> ||
    std::same_as<T, char16_t> || std::same_as<T, char32_t>;

// With the compiler's own extensions they are integral, too.
__extension__ using Signed128 = __int128;
__extension__ using Unsigned128 = unsigned __int128;
template <class T>
concept Integer128 = std::same_as<T, Signed128> || std::same_as<T, Unsigned128>;

template <class T>
concept Integer = std::integral<T> && !std::same_as<T, bool> && !Character<T> && !Integer128<T>;

template <class T>
concept Array = ArrayTraits<T>::is_array;

template <class T>
concept SequenceOf = SequenceTraits<T>::is_sequence;

// What arrays and sequences of such are made of in the end, or the type itself.
template <class T>
struct InnermostOf {
  using Type = T;
};
template <Array T>
struct InnermostOf<T> : InnermostOf<typename ArrayTraits<T>::Element> {};
template <SequenceOf T>
struct InnermostOf<T> : InnermostOf<typename SequenceTraits<T>::Element> {};
template <class T>
using Innermost = typename InnermostOf<T>::Type;

}  // namespace detail
}  // namespace jarol
