#include "runtime/record/chunk_queue.h"

#include <utility>

namespace jarol {

ChunkQueue::~ChunkQueue() {
  try {
    close();
  } catch (...) {
    // whoever cares for a loss closes first
  }
}

void ChunkQueue::start(std::function<void(const mcap::Chunk&)> write) {
  write_ = std::move(write);
  thread_ = std::thread([this] { run(); });
}

ChunkQueue::ChunkPointer ChunkQueue::empty_chunk() {
  const std::lock_guard lock(mutex_);
  if (spare_.empty()) return std::make_unique<mcap::Chunk>();
  ChunkPointer chunk = std::move(spare_.back());
  spare_.pop_back();
  return chunk;
}

void ChunkQueue::push(ChunkPointer chunk) {
  const std::lock_guard lock(mutex_);
  put(std::move(chunk));
}

void ChunkQueue::wait_and_push(ChunkPointer chunk) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&, bytes = chunk->records().size()] { return has_room(bytes) || failure_ || ended_; });
  put(std::move(chunk));
}

bool ChunkQueue::has_room_for(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  return has_room(bytes);
}

bool ChunkQueue::has_room(std::size_t bytes) const {
  return waiting_.empty() || (waiting_.size() < room && waiting_bytes_ + bytes <= max_bytes);
}

void ChunkQueue::put(ChunkPointer chunk) {
  if (failure_ || ended_) return;  // nothing is written any more
  waiting_bytes_ += chunk->records().size();
  waiting_.push_back(std::move(chunk));
  pushed_.fetch_add(1, std::memory_order_relaxed);
  changed_.notify_all();
}

void ChunkQueue::close() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  thread_.join();
  if (failure_) std::rethrow_exception(failure_);
}

void ChunkQueue::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return !waiting_.empty() || ended_; });
    if (waiting_.empty()) return;
    // it stands in the queue until it is written, so that those who wait count it
    mcap::Chunk& chunk = *waiting_.front();
    lock.unlock();
    std::exception_ptr failure;
    try {
      write_(chunk);
    } catch (...) { failure = std::current_exception(); }
    const std::size_t bytes = chunk.records().size();
    chunk.clear();
    lock.lock();
    waiting_bytes_ -= bytes;
    if (bytes <= max_bytes / room) spare_.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
    if (failure) {
      failure_ = failure;
      waiting_.clear();
      waiting_bytes_ = 0;
    }
    changed_.notify_all();
  }
}

}  // namespace jarol
