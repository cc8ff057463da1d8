#include "graph/values/heap.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdio>
#include <cstring>

namespace jarol {
namespace {

constexpr std::size_t min = smallest_heap;  // bytes of a block

struct BlockClass {
  std::size_t size;
  std::size_t index;
};

// Four sizes for each power of two, so that at most a fifth of a block is lost.
BlockClass class_of(std::size_t bytes) {
  const std::size_t wanted = std::max(bytes, min);
  if (wanted <= 4 * min) {
    const std::size_t units = (wanted + min - 1) / min;
    return {units * min, units - 1};
  }
  const auto exponent = static_cast<std::size_t>(std::bit_width(wanted - 1));  // 2^(exponent-1) < wanted <= 2^exponent
  const std::size_t step = std::size_t{1} << (exponent - 3);
  const std::size_t steps = (wanted + step - 1) / step;  // 5 to 8
  return {steps * step, 4 + 4 * (exponent - 7) + (steps - 5)};
}

class NoHeap : public std::pmr::memory_resource {
  void* do_allocate(std::size_t bytes, std::size_t) override { throw HeapExhausted(bytes, 0, 0); }
  void do_deallocate(void*, std::size_t, std::size_t) override {}
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }
};

std::pmr::memory_resource*& memory_of_thread() {
  thread_local std::pmr::memory_resource* memory = nullptr;
  return memory;
}

}  // namespace

HeapExhausted::HeapExhausted(std::size_t wanted, std::size_t used, std::size_t size) noexcept {
  if (size == 0) {
    std::snprintf(text_, sizeof text_, "it has no heap for the %zu bytes it wants; add one, as in heap: 64KiB", wanted);
    return;
  }
  const int end = std::snprintf(text_, sizeof text_, "%zu bytes more do not fit its heap: %zu of %zu bytes are in use",
                                wanted, used, size);
  if (wanted > largest_heap - used) return;  // none would do
  // a power of two, as people write sizes
  const std::size_t enough = std::bit_ceil(std::max(used + wanted, size + 1));
  const bool large = enough >= 1024;
  std::snprintf(text_ + end, sizeof text_ - static_cast<std::size_t>(end), "; give it a larger one, as in heap: %zu%s",
                large ? enough / 1024 : enough, large ? "KiB" : "B");
}

void detail::throw_no_element(std::size_t index, std::size_t length) {
  char text[80];
  std::snprintf(text, sizeof text, "element %zu of a sequence of %zu", index, length);
  throw std::out_of_range(text);
}

PrivateHeap::PrivateHeap(std::byte* region, std::size_t size)
    : region_(region), size_(size / min * min) {  // scratch is handed out from the end
  book_.scratch = size_;
}

std::size_t PrivateHeap::block_size(std::size_t bytes) { return class_of(bytes).size; }

void PrivateHeap::exhausted(std::size_t wanted) const { throw HeapExhausted(wanted, size_ - room(), size_); }

void PrivateHeap::note_use() { max_used_ = std::max(max_used_, size_ - room()); }

void PrivateHeap::keep(std::byte* room) {
  kept_ = book_;
  std::memcpy(room, region_, book_.values);
}

void PrivateHeap::restore(const std::byte* room) {
  book_ = kept_;
  std::memcpy(region_, room, book_.values);
}

void* PrivateHeap::Values::do_allocate(std::size_t bytes, [[maybe_unused]] std::size_t alignment) {
  assert(alignment <= min);
  if (bytes > heap.size_) heap.exhausted(bytes);
  const BlockClass block = class_of(bytes);
  void*& free = heap.book_.free[block.index];
  if (free != nullptr) {
    void* const taken = free;
    std::memcpy(&free, taken, sizeof free);
    return taken;
  }
  if (block.size > heap.room()) heap.exhausted(bytes);
  std::byte* const taken = heap.region_ + heap.book_.values;
  heap.book_.values += block.size;
  heap.note_use();
  return taken;
}

void PrivateHeap::Values::do_deallocate(void* block, std::size_t bytes, std::size_t) {
  const BlockClass size = class_of(bytes);
  if (static_cast<std::byte*>(block) + size.size == heap.region_ + heap.book_.values) {
    heap.book_.values -= size.size;  // the topmost one
    return;
  }
  void*& free = heap.book_.free[size.index];
  std::memcpy(block, &free, sizeof free);
  free = block;
}

void* PrivateHeap::Scratch::do_allocate(std::size_t bytes, [[maybe_unused]] std::size_t alignment) {
  assert(alignment <= min);
  if (bytes > heap.room()) heap.exhausted(bytes);
  const std::size_t size = (bytes + min - 1) / min * min;
  if (size > heap.room()) heap.exhausted(bytes);
  heap.book_.scratch -= size;
  heap.note_use();
  return heap.region_ + heap.book_.scratch;
}

void PrivateHeap::Scratch::do_deallocate(void* block, std::size_t bytes, std::size_t) {
  // the newest one only; all others wait for the end of the activation
  if (block == heap.region_ + heap.book_.scratch) heap.book_.scratch += (bytes + min - 1) / min * min;
}

std::pmr::memory_resource* memory_of_now() {
  std::pmr::memory_resource* const memory = memory_of_thread();
  return memory != nullptr ? memory : std::pmr::new_delete_resource();
}

MemoryScope::MemoryScope(std::pmr::memory_resource* memory) : before_(memory_of_thread()) {
  memory_of_thread() = memory;
}

MemoryScope::~MemoryScope() { memory_of_thread() = before_; }

std::pmr::memory_resource* no_heap() {
  static NoHeap none;
  return &none;
}

}  // namespace jarol
