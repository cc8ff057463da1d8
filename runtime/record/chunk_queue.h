// Chunks on their way to the file: a thread of its own writes them, so that nobody else waits for the disk.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "runtime/mcap/chunk.h"

namespace jarol {

class ChunkQueue {
 public:
  using ChunkPointer = std::unique_ptr<mcap::Chunk>;

  ChunkQueue() = default;
  ~ChunkQueue();
  ChunkQueue(const ChunkQueue&) = delete;
  ChunkQueue& operator=(const ChunkQueue&) = delete;

  /// From now on `write` gets the chunks, in the order in which they were pushed, on the thread of the queue. After
  /// what it throws it is called no more.
  void start(std::function<void(const mcap::Chunk&)> write);

  /// An empty chunk, with the memory of one that was written if there is one.
  ChunkPointer empty_chunk();

  /// However many wait to be written.
  void push(ChunkPointer chunk);
  /// Waits until fewer than `room` wait, and of large ones no more than `max_bytes`, or none.
  void wait_and_push(ChunkPointer chunk);
  /// So few wait that one of so many bytes would not have to.
  bool has_room_for(std::size_t bytes);
  /// Chunks that may wait, but for those that are pushed in any case.
  static constexpr std::size_t room = 16;
  static constexpr std::size_t max_bytes = std::size_t{64} << 20;

  /// Chunks that were pushed so far, by all.
  std::uint64_t pushed() const { return pushed_.load(std::memory_order_relaxed); }

  /// Ends the thread once all is written; throws what `write` threw.
  void close();

 private:
  void run();
  void put(ChunkPointer chunk);
  bool has_room(std::size_t bytes) const;

  std::function<void(const mcap::Chunk&)> write_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ChunkPointer> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::vector<ChunkPointer> spare_;
  std::atomic<std::uint64_t> pushed_{0};
  bool ended_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace jarol
