// The Jarol push port: as a port, but what is written overwrites the oldest value where there is no room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "runtime/jarol/slots.h"
#include "runtime/jarol/values_port.h"

namespace jarol {

// A slot has a mark and the value in words. Value i: the writer sets the mark to 2i + 1, stores the words, and sets the
// mark to 2i + 2. The reader loads mark, words and mark. Everything stores with release and loads with acquire. Then
//  - a value whose first mark was 2i + 2 has no word older than value i: its words happened before that mark;
//  - if a word is of a newer value, that value's first mark happened before the word, and so the second mark loaded
//    can't be 2i + 2 again: the value is not taken. So none is torn. All is atomic: there is no data race;
//  - half of any mark is a number of values that were written, all of which happened before it. The reader goes on to
//    the oldest of the newest `capacity` of them, and never back: nothing is stale after newer, nothing reordered.
// The slot in addition to `capacity` is the one that is being overwritten. Marks have 64 bits, which no run exhausts.
template <class Memory>
class BasicPushPort {
 public:
  /// Holds the newest `capacity` values of `size` bytes; at least one.
  BasicPushPort(std::size_t capacity, std::size_t size)
      : slots_(one_more(at_least_one(capacity)), 0, 1 + (size + 7) / 8), size_(size), capacity_(capacity) {}

  std::size_t capacity() const { return capacity_; }
  /// Bytes of a value.
  std::size_t size() const { return size_; }

  /// Writer: copies the value, always and in bounded time; true.
  bool write(const void* from) {
    return write_with([&](auto cell) { cell.put(0, from, size_); });
  }

  /// Reader: takes the oldest value; false, and `to` stays as it is, if there is none. Tries again only if the writer
  /// overwrote the value meanwhile.
  bool read(void* to) {
    return read_with([&](auto cell) { cell.get(0, to, size_); });
  }

  /// Reader: values that were overwritten before they were read, as far as it came across.
  std::uint64_t lost() const { return reader_.lost; }

  /// A value inside its slot, in parts that begin at whole words.
  struct Cell {
    typename Slots<Memory>::Word* words;

    void put(std::size_t offset, const void* from, std::size_t count) {
      const auto* bytes = static_cast<const std::byte*>(from);
      auto* word = words + offset / 8;
      for (; count >= 8; count -= 8, bytes += 8, ++word) store(*word, bytes, 8);
      if (count > 0) store(*word, bytes, count);
    }
    void get(std::size_t offset, void* to, std::size_t count) {
      auto* bytes = static_cast<std::byte*>(to);
      const auto* word = words + offset / 8;
      for (; count >= 8; count -= 8, bytes += 8, ++word) load(*word, bytes, 8);
      if (count > 0) load(*word, bytes, count);
    }

   private:
    static void store(typename Slots<Memory>::Word& word, const std::byte* from, std::size_t count) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, from, count);
      word.store(bits, std::memory_order_release);
    }
    static void load(const typename Slots<Memory>::Word& word, std::byte* to, std::size_t count) {
      const std::uint64_t bits = word.load(std::memory_order_acquire);
      std::memcpy(to, &bits, count);
    }
  };

  template <class Put>
  bool write_with(Put put) {
    Writer& w = writer_;
    auto* const words = slots_.words(w.slot);
    words->store(2 * w.written + 1, std::memory_order_release);
    put(Cell{words + 1});
    ++w.written;
    words->store(2 * w.written, std::memory_order_release);
    w.slot = slots_.after(w.slot);
    return true;
  }

  /// `get` may be called again, after it saw a value that is none.
  template <class Get>
  bool read_with(Get get) {
    for (Reader& r = reader_;;) {
      auto* const words = slots_.words(r.slot);
      std::uint64_t mark = words->load(std::memory_order_acquire);
      if (mark / 2 <= r.next) return false;
      if (mark == 2 * r.next + 2) {
        // the slot before this one shows whether the value still is one of the newest
        const std::uint64_t newest = slots_.words(slots_.before(r.slot))->load(std::memory_order_acquire);
        if (newest / 2 > r.next + capacity_) {
          skip(r, newest / 2);
          continue;
        }
        get(Cell{words + 1});
        mark = words->load(std::memory_order_acquire);
        if (mark == 2 * r.next + 2) {
          ++r.next;
          r.slot = slots_.after(r.slot);
          return true;
        }
      }
      skip(r, mark / 2);
    }
  }

 private:
  struct Writer {
    std::uint64_t written = 0;
    std::size_t slot = 0;
  };
  struct Reader {
    std::uint64_t next = 0;
    std::size_t slot = 0;
    std::uint64_t lost = 0;
  };

  static std::size_t at_least_one(std::size_t capacity) {
    if (capacity == 0) throw std::invalid_argument("a push port holds at least one value");
    return capacity;
  }

  // what would wrap is left to the slots to refuse
  static std::size_t one_more(std::size_t capacity) { return capacity + 1 == 0 ? capacity : capacity + 1; }

  void skip(Reader& r, std::uint64_t written) {
    const std::uint64_t oldest = written - capacity_;
    r.lost += oldest - r.next;
    r.next = oldest;
    r.slot = static_cast<std::size_t>(oldest % slots_.count());
  }

  Slots<Memory> slots_;
  std::size_t size_;
  std::size_t capacity_;
  alignas(apart) Writer writer_;
  alignas(apart) Reader reader_;
};

/// For flat values of a size that is known at construction.
using PushBytesPort = BasicPushPort<Memory>;
/// For flat values of one type.
template <class T>
using PushPort = ValuesPort<T, BasicPushPort<Memory>>;
/// For packets of up to so many bytes.
using PushPacketPort = PacketsPort<BasicPushPort<Memory>>;

}  // namespace jarol
