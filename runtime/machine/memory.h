// What lock-free code asks of the machine. Tests put a model in its place and try out all that may happen.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace jarol {

/// Data of two threads keep this distance, so that neither slows the other down (two lines: they are fetched in pairs).
inline constexpr std::size_t apart = 128;

static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "counts and marks of ports, and the words of values");

struct Memory {
  template <class T>
  using Atomic = std::atomic<T>;

  /// Plain bytes that only one thread at a time may touch.
  static void copy_in(std::byte* to, const void* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
  static void copy_out(void* to, const std::byte* from, std::size_t bytes) { std::memcpy(to, from, bytes); }
};

}  // namespace jarol
