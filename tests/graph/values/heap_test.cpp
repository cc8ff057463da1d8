#include "graph/values/heap.h"

#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace {
using namespace jarol;

struct Region {
  explicit Region(std::size_t size) : bytes(size), heap(reinterpret_cast<std::byte*>(bytes.data()), size) {}
  std::vector<char> bytes;
  PrivateHeap heap;
};

std::string what_of(std::pmr::memory_resource* memory, std::size_t bytes) {
  try {
    static_cast<void>(memory->allocate(bytes, 16));
  } catch (const HeapExhausted& error) { return error.what(); }
  return "";
}
}  // namespace

TEST_SUITE("graph/values/heap") {
  TEST_CASE("a block is at most a quarter larger than what is asked for, and never smaller") {
    for (std::size_t bytes = 1; bytes < 100'000; bytes += 7) {
      const std::size_t block = PrivateHeap::block_size(bytes);
      CHECK(block >= bytes);
      CHECK(block <= std::max(bytes + 15, bytes + bytes / 4));
      CHECK(PrivateHeap::block_size(block) == block);
    }
  }

  TEST_CASE("a freed block is used again for the next of its size") {
    Region r(4096);
    void* const first = r.heap.values()->allocate(100, 16);
    void* const second = r.heap.values()->allocate(100, 16);
    r.heap.values()->deallocate(first, 100, 16);
    CHECK(r.heap.values()->allocate(98, 16) == first);
    CHECK(second != first);
    CHECK(r.heap.max_used() == 224);
  }

  TEST_CASE("scratch is released at once and counts towards the most that was used") {
    Region r(4096);
    static_cast<void>(r.heap.values()->allocate(64, 16));
    for (int i = 0; i < 10; ++i) {
      static_cast<void>(r.heap.scratch()->allocate(1000, 16));
      static_cast<void>(r.heap.scratch()->allocate(1000, 16));
      r.heap.release_scratch();
    }
    CHECK(r.heap.max_used() == 64 + 2 * 1008);
  }

  TEST_CASE("what does not fit is refused with the sizes, and what is there stays") {
    Region r(1024);
    void* const kept = r.heap.values()->allocate(512, 16);
    std::memset(kept, 7, 512);
    CHECK(what_of(r.heap.values(), 513) ==
          "513 bytes more do not fit its heap: 512 of 1024 bytes are in use; give it a larger one, as in heap: 2KiB");
    CHECK(what_of(r.heap.scratch(), 600) ==
          "600 bytes more do not fit its heap: 512 of 1024 bytes are in use; give it a larger one, as in heap: 2KiB");
    CHECK(what_of(r.heap.values(), ~std::size_t{0}) ==
          "18446744073709551615 bytes more do not fit its heap: 512 of 1024 bytes are in use");
    CHECK(what_of(r.heap.scratch(), ~std::size_t{0}) ==
          "18446744073709551615 bytes more do not fit its heap: 512 of 1024 bytes are in use");
    CHECK(what_of(no_heap(), 8) == "it has no heap for the 8 bytes it wants; add one, as in heap: 64KiB");
    CHECK(static_cast<char*>(kept)[511] == 7);
  }

  TEST_CASE("values are put back as they were kept, with what was free then") {
    Region r(4096);
    std::vector<std::byte> room(4096);
    auto* const value = static_cast<char*>(r.heap.values()->allocate(64, 16));
    void* const freed = r.heap.values()->allocate(128, 16);
    static_cast<void>(r.heap.values()->allocate(16, 16));
    r.heap.values()->deallocate(freed, 128, 16);
    std::strcpy(value, "before");
    r.heap.keep(room.data());
    std::strcpy(value, "after");
    CHECK(r.heap.values()->allocate(128, 16) == freed);
    static_cast<void>(r.heap.values()->allocate(256, 16));
    r.heap.restore(room.data());
    CHECK(std::string(value) == "before");
    CHECK(r.heap.values()->allocate(128, 16) == freed);
  }
}
