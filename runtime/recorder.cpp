#include "runtime/recorder.h"

#include <cassert>

namespace jarol {
namespace {
constexpr std::uint64_t ended = std::uint64_t{1} << 63;
}

Recorder::Recorder(std::vector<RecordSink*> sinks)
    : sinks_(std::move(sinks)), memory_(std::make_unique<std::byte[]>(chunk_bytes * chunks)), now_(memory_.get()) {
  thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() {
  try {
    close();
  } catch (...) {
    // whoever cares for a loss closes first
  }
}

void Recorder::close() {
  if (!thread_.joinable()) return;
  if (used_ > 0) publish_chunk();
  // the end is part of the awaited word: a flag of its own could be set between test and wait
  written_.fetch_or(ended, std::memory_order_release);
  written_.notify_one();
  thread_.join();
  if (failure_) std::rethrow_exception(failure_);
}

void Recorder::publish_chunk() {
  const std::uint64_t index = written_.load(std::memory_order_relaxed);
  bytes_[index % chunks] = used_;
  written_.store(index + 1, std::memory_order_release);
  written_.notify_one();
  used_ = 0;
}

void Recorder::next_chunk([[maybe_unused]] std::size_t needed) {
  assert(needed <= chunk_bytes);
  publish_chunk();
  const std::uint64_t next = written_.load(std::memory_order_relaxed);
  for (std::uint64_t read = read_.load(std::memory_order_acquire); next - read >= chunks;
       read = read_.load(std::memory_order_acquire))
    read_.wait(read, std::memory_order_acquire);
  now_ = memory_.get() + (next % chunks) * chunk_bytes;
}

void Recorder::run() {
  std::uint64_t read = 0;
  while (true) {
    const std::uint64_t written = written_.load(std::memory_order_acquire);
    if ((written & ~ended) == read) {
      if ((written & ended) != 0) break;
      written_.wait(written, std::memory_order_acquire);
      continue;
    }
    drain(memory_.get() + (read % chunks) * chunk_bytes, bytes_[read % chunks]);
    read_.store(++read, std::memory_order_release);
    read_.notify_one();
  }
  try {
    for (RecordSink* sink : sinks_) sink->finish();
  } catch (...) {
    if (!failure_) failure_ = std::current_exception();
  }
}

void Recorder::drain(const std::byte* chunk, std::size_t bytes) {
  if (failure_) return;  // go on emptying the ring, so that the run itself is not held up
  try {
    for (std::size_t at = 0; at < bytes;) {
      RecordHeader header;
      std::memcpy(&header, chunk + at, sizeof header);
      for (RecordSink* sink : sinks_) sink->take(Duration(header.instant), header.output, chunk + at + sizeof header);
      at += sizeof header + ((header.size + 7U) & ~std::size_t{7});
    }
  } catch (...) { failure_ = std::current_exception(); }
}

}  // namespace jarol
