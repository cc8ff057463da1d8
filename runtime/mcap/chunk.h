// A chunk that is being filled: records in memory, and their check sum.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstring>
#include <memory>
#include <string_view>

#include "runtime/machine/large_pages.h"
#include "runtime/machine/prefetch.h"
#include "runtime/mcap/crc32.h"
#include "runtime/mcap/records.h"

namespace jarol::mcap {

class Chunk {
 public:
  Chunk() = default;

  /// So much memory, from the system now and not when it is first written to.
  void reserve(std::size_t bytes) {
    if (capacity_ < bytes) use(make_large_zeros(bytes), bytes);
  }

  /// A schema or a channel, before its first message.
  void add(std::string_view record) { std::memcpy(room_for(record.size()), record.data(), record.size()); }

  /// The caller writes its data there.
  std::byte* add_message(std::uint16_t channel, std::uint32_t sequence, Duration time, std::size_t size) {
    if (size_ - summed_ >= summed_at_once) sum();
    std::byte* const at = room_for(message_head + size);
    prefetch_for_write(memory_.get(), capacity_, size_);
    const auto opcode = Opcode::message;
    const std::uint64_t length = message_head - record_head + size;
    std::memcpy(at, &opcode, 1);
    std::memcpy(at + 1, &length, 8);
    std::memcpy(at + 9, &channel, 2);
    std::memcpy(at + 11, &sequence, 4);
    const std::int64_t ns = time.count();
    std::memcpy(at + 15, &ns, 8);
    std::memcpy(at + 23, &ns, 8);
    if (messages_++ == 0) start_ = end_ = time;
    start_ = std::min(start_, time);
    end_ = std::max(end_, time);
    return at + message_head;
  }

  /// Nothing comes after this. By the thread that has filled it, which has summed up nearly all of it on the way.
  void seal() {
    sum();
    sealed_ = true;
  }
  /// Of the records.
  std::uint32_t crc() const { return crc32(records().substr(summed_), crc_); }

  std::string_view records() const { return {reinterpret_cast<const char*>(memory_.get()), size_}; }
  std::uint64_t messages() const { return messages_; }
  Duration start() const { return start_; }
  Duration end() const { return end_; }

  /// Its memory stays.
  void clear() {
    size_ = summed_ = 0;
    crc_ = 0;
    sealed_ = false;
    messages_ = 0;
    start_ = end_ = Duration{};
  }

 private:
  std::byte* room_for(std::size_t bytes) {
    assert(!sealed_);
    if (capacity_ - size_ < bytes) grow(bytes);
    std::byte* const at = memory_.get() + size_;
    size_ += bytes;
    return at;
  }
  // While the cache of the core still has it.
  static constexpr std::size_t summed_at_once = std::size_t{1} << 15;
  [[gnu::noinline]] void sum() {
    crc_ = crc32(records().substr(summed_), crc_);
    summed_ = size_;
  }
  [[gnu::cold]] void grow(std::size_t bytes) {
    // what is filled quickly is soon on a large page
    constexpr std::size_t first = std::size_t{1} << 16, quickly = std::size_t{1} << 18;
    std::size_t capacity = std::max({2 * capacity_, size_ + bytes, first});
    if (capacity > quickly) capacity = std::max(capacity, large_page);
    use(make_large(capacity), capacity);
  }
  void use(LargeMemory larger, std::size_t capacity) {
    if (size_ > 0) std::memcpy(larger.get(), memory_.get(), size_);
    memory_ = std::move(larger);
    capacity_ = capacity;
  }

  LargeMemory memory_;
  std::size_t capacity_ = 0, size_ = 0;
  std::size_t summed_ = 0;  // so many bytes
  std::uint32_t crc_ = 0;   // of these
  bool sealed_ = false;
  std::uint64_t messages_ = 0;
  Duration start_{}, end_{};
};

}  // namespace jarol::mcap
