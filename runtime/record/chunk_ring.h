// Chunks between the thread that fills them and the one that hands them on to the queue; neither locks.
#pragma once

#include <array>
#include <atomic>
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
  /// There is an empty chunk after that one.
  bool has_room() const { return waiting() + 1 < chunks; }
  void wait_for_room() const {
    for (std::uint64_t taken = taken_.load(std::memory_order_acquire);
         filled_.load(std::memory_order_relaxed) + 1 - taken >= chunks; taken = taken_.load(std::memory_order_acquire))
      taken_.wait(taken, std::memory_order_acquire);
  }
  /// It is full, and the next one is filled. Where there is room.
  void next() { filled_.store(filled_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  // By the thread that hands on:

  /// The oldest that is full; null: there is none.
  ChunkPointer* full() {
    const std::uint64_t taken = taken_.load(std::memory_order_relaxed);
    return filled_.load(std::memory_order_acquire) == taken ? nullptr : &chunks_[taken % chunks];
  }
  /// In its place an empty one stands.
  void taken() {
    taken_.store(taken_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    taken_.notify_one();
  }

  // By either:

  /// So many are full.
  std::uint64_t waiting() const {
    return filled_.load(std::memory_order_acquire) - taken_.load(std::memory_order_acquire);
  }
  static constexpr std::uint64_t chunks = 16;

 private:
  std::array<ChunkPointer, chunks> chunks_;
  std::atomic<std::uint64_t> filled_{0}, taken_{0};
};

}  // namespace jarol
