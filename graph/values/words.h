// The words of a value, of which its digest is made.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

#include "graph/values/digest.h"
#include "graph/values/parts.h"

namespace jarol::detail {

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
    with_described(value, [&](const auto&... member) { (for_each_word(member, visit), ...); });
  }
}

template <class T>
inline std::uint64_t hash_words(const T& value) {
  digest::Words words;
  for_each_word(value, [&](std::uint64_t word) { words.add(word); });
  return words.sum();
}

}  // namespace jarol::detail
