// Chunks between the thread that fills them and the one that hands them on to the queue; neither locks.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "runtime/record/chunk_queue.h"

namespace jarol {

class ChunkRing {
 public:
  using ChunkPointer = ChunkQueue::ChunkPointer;

  /// `make` makes an empty chunk.
  template <class Make>
  explicit ChunkRing(const Make& make) {
    for (ChunkPointer& chunk : chunks_) chunk = make();
  }

  // By the thread that fills:

  mcap::Chunk& filling() { return *chunks_[filled_.load(std::memory_order_relaxed) % chunks]; }
  /// So many are full.
  std::uint64_t waiting() const {
    return filled_.load(std::memory_order_relaxed) - taken_.load(std::memory_order_acquire);
  }
  /// There is an empty chunk after that one, and those that are full have no more bytes than may wait in the queue.
  bool has_room() const {
    const std::uint64_t full = waiting();
    return full == 0 || (full + 1 < chunks && bytes_.load(std::memory_order_relaxed) <= ChunkQueue::max_bytes);
  }
  void wait_for_room() const {
    for (std::uint64_t taken = taken_.load(std::memory_order_acquire); !has_room();
         taken = taken_.load(std::memory_order_acquire))
      taken_.wait(taken, std::memory_order_acquire);
  }
  /// It is full, and the next one is filled. Where there is room.
  void next() {
    bytes_.fetch_add(filling().records().size(), std::memory_order_relaxed);
    filled_.store(filled_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  // By the thread that hands on:

  /// The oldest that is full; null: there is none.
  ChunkPointer* full() {
    const std::uint64_t taken = taken_.load(std::memory_order_relaxed);
    return filled_.load(std::memory_order_acquire) == taken ? nullptr : &chunks_[taken % chunks];
  }
  /// In its place an empty one stands; it had so many bytes.
  void taken(std::size_t bytes) {
    bytes_.fetch_sub(bytes, std::memory_order_relaxed);
    taken_.store(taken_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    taken_.notify_one();
  }

  static constexpr std::uint64_t chunks = 16;

 private:
  std::array<ChunkPointer, chunks> chunks_;
  std::atomic<std::uint64_t> filled_{0}, taken_{0};
  std::atomic<std::size_t> bytes_{0};  // of those that are full
};

}  // namespace jarol
