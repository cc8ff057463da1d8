// Memory of some MiB on large pages, where the system has them for whoever asks: a processor remembers the places of so
// many pages, and what lies on more of them than that it looks up again at each activation.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

namespace jarol {

inline constexpr std::size_t large_page = std::size_t{2} << 20;  // bytes

/// Less than one such page is memory as any other. Throws std::bad_alloc.
void* take_large(std::size_t bytes, std::size_t alignment);
/// With the same numbers.
void give_back_large(void* memory, std::size_t bytes, std::size_t alignment) noexcept;

struct GiveBackLarge {
  std::size_t bytes = 0, alignment = 1;
  void operator()(std::byte* memory) const noexcept { give_back_large(memory, bytes, alignment); }
};
using LargeMemory = std::unique_ptr<std::byte, GiveBackLarge>;

/// The same, owned. What stands there is not known.
inline LargeMemory make_large(std::size_t bytes, std::size_t alignment = alignof(std::max_align_t)) {
  return {static_cast<std::byte*>(take_large(bytes, alignment)), {bytes, alignment}};
}

/// The same, of zeros, and given by the system now and not when it is first written to.
inline LargeMemory make_large_zeros(std::size_t bytes, std::size_t alignment = alignof(std::max_align_t)) {
  LargeMemory memory = make_large(bytes, alignment);
  std::memset(memory.get(), 0, bytes);
  return memory;
}

/// The allocator of LargeVector.
template <class T>
struct LargePages {
  using value_type = T;

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  T* allocate(std::size_t n) { return static_cast<T*>(take_large(n * sizeof(T), alignof(T))); }
  void deallocate(T* all, std::size_t n) noexcept { give_back_large(all, n * sizeof(T), alignof(T)); }

  bool operator==(const LargePages&) const { return true; }
};

/// What is read at each activation, of as many tasks as there are.
template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace jarol
