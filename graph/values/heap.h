// The private heap of a task: one region of fixed size for the values of changing size that it owns, and for what an
// activation allocates beside them. Nothing in it depends on addresses or on other tasks, so that running out of it is
// as repeatable as everything else.
#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>
#include <new>
#include <utility>
#include <vector>

namespace jarol {

class Archive;

/// In bytes, of one task.
inline constexpr std::size_t largest_heap = std::size_t{1} << 30;
inline constexpr std::size_t smallest_heap = 16;

/// The heap can't hold what is wanted; says how much, of how much, and which might.
class HeapExhausted final : public std::bad_alloc {
 public:
  HeapExhausted(std::size_t wanted, std::size_t used, std::size_t size) noexcept;
  const char* what() const noexcept override { return text_; }

 private:
  char text_[160] = "";
};

namespace detail {
/// Of a sequence. Out of line: a text that is made in a task would be memory of the global allocator.
[[noreturn]] void throw_no_element(std::size_t index, std::size_t length);
}  // namespace detail

/// Values grow from the bottom of the region, in blocks of some 120 sizes of which freed ones are used again; scratch
/// grows from its top and is released as a whole. All in constant time.
class PrivateHeap {
 public:
  /// The region is aligned to 16 bytes and outlives the heap.
  PrivateHeap(std::byte* region, std::size_t size);
  PrivateHeap(const PrivateHeap&) = delete;
  PrivateHeap& operator=(const PrivateHeap&) = delete;

  std::pmr::memory_resource* values() { return &values_; }
  std::pmr::memory_resource* scratch() { return &scratch_; }

  /// Frees all scratch at once.
  void release_scratch() { book_.scratch = size_; }

  std::size_t size() const { return size_; }
  /// The most bytes that were ever in use at once, of values and scratch together.
  std::size_t max_used() const { return max_used_; }

  /// Keeps all values as they are, bit by bit, and puts them back; `room` has size() bytes.
  void keep(std::byte* room);
  void restore(const std::byte* room);

  /// Bytes that a block for `bytes` takes.
  static std::size_t block_size(std::size_t bytes);

  /// A block of values: where it begins in the region, and its bytes.
  using Block = std::pair<std::size_t, std::size_t>;
  /// What is in use and what is free, between activations; without the values. Adds the free blocks.
  void serialize(Archive& archive, std::vector<Block>& free);
  /// Of an address in it, and back.
  std::size_t place_of(const void* in_region) const {
    return static_cast<std::size_t>(static_cast<const std::byte*>(in_region) - region_);
  }
  std::byte* at(std::size_t place) const { return region_ + place; }
  /// Where the values end.
  std::size_t end_of_values() const { return book_.values; }

 private:
  struct Values : std::pmr::memory_resource {
    explicit Values(PrivateHeap& owner) : heap(owner) {}
    void* do_allocate(std::size_t bytes, std::size_t alignment) override;
    void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override;
    bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }
    PrivateHeap& heap;
  };
  struct Scratch : std::pmr::memory_resource {
    explicit Scratch(PrivateHeap& owner) : heap(owner) {}
    void* do_allocate(std::size_t bytes, std::size_t alignment) override;
    void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override;
    bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }
    PrivateHeap& heap;
  };
  // what is in use: saved and restored as a whole
  struct Book {
    std::array<void*, 160> free{};  // per size of block: freed ones, each holding the address of the next
    std::size_t values = 0;         // end of the values
    std::size_t scratch = 0;        // begin of the scratch
  };

  std::size_t room() const { return book_.scratch - book_.values; }
  [[noreturn]] void exhausted(std::size_t wanted) const;
  void note_use();

  std::byte* region_;
  std::size_t size_;
  std::size_t max_used_ = 0;
  Book book_;
  Book kept_;
  Values values_{*this};
  Scratch scratch_{*this};
};

/// Where values of changing size go that belong to no task or communicator: scratch within an activation, the global
/// allocator elsewhere.
std::pmr::memory_resource* memory_of_now();

/// Sets `memory_of_now` of this thread while it lives; null is the global allocator.
class MemoryScope {
 public:
  explicit MemoryScope(std::pmr::memory_resource* memory);
  ~MemoryScope();
  MemoryScope(const MemoryScope&) = delete;
  MemoryScope& operator=(const MemoryScope&) = delete;

 private:
  std::pmr::memory_resource* before_;
};

/// Has no room for anything: what tasks without a heap allocate from.
std::pmr::memory_resource* no_heap();

}  // namespace jarol
