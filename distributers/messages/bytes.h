// Numbers of one to eight bytes in either order.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "distributers/messages/message_set.h"

namespace jarol::messages {

static_assert(std::endian::native == std::endian::little, "values in memory are little-endian");

constexpr ByteOrder other(ByteOrder order) { return order == ByteOrder::little ? ByteOrder::big : ByteOrder::little; }

namespace detail {

// a size known at compile time makes a swap one instruction
template <std::size_t Size>
void copy_swapped(std::byte* to, const std::byte* from, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    std::byte number[Size];
    std::memcpy(number, from + i * Size, Size);
    std::reverse(number, number + Size);
    std::memcpy(to + i * Size, number, Size);
  }
}

template <std::size_t Size>
void copy_sized(std::byte* to, const std::byte* from, std::size_t count, bool swap) {
  if (swap) return copy_swapped<Size>(to, from, count);
  std::memmove(to, from, Size * count);
}

}  // namespace detail

/// Copies `count` numbers of 1, 2, 4 or 8 bytes, each reversed if `swap`; `to` may be `from`.
inline void copy_numbers(void* to, const void* from, std::size_t size, std::size_t count, bool swap) {
  auto* const t = static_cast<std::byte*>(to);
  const auto* const f = static_cast<const std::byte*>(from);
  switch (size) {
    case 1: return detail::copy_sized<1>(t, f, count, false);
    case 2: return detail::copy_sized<2>(t, f, count, swap);
    case 4: return detail::copy_sized<4>(t, f, count, swap);
    default: return detail::copy_sized<8>(t, f, count, swap);
  }
}

inline std::uint64_t load_unsigned(const std::byte* from, std::size_t size, ByteOrder order) {
  std::uint64_t value = 0;
  copy_numbers(&value, from, size, 1, order == ByteOrder::big);
  return value;
}

inline void store_unsigned(std::byte* to, std::size_t size, ByteOrder order, std::uint64_t value) {
  copy_numbers(to, &value, size, 1, order == ByteOrder::big);
}

inline void append_unsigned(std::vector<std::byte>& to, std::size_t size, ByteOrder order, std::uint64_t value) {
  to.resize(to.size() + size);
  store_unsigned(to.data() + to.size() - size, size, order, value);
}

}  // namespace jarol::messages
