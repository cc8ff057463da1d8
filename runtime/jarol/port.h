// The Jarol port: values from one writing thread to one reading thread, bounded, without locks, refusing when full.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "runtime/jarol/slots.h"
#include "runtime/jarol/values_port.h"

namespace jarol {

// A slot belongs to the writer until its value is counted as written, then to the reader until it is counted as taken;
// both counts are stored with release and loaded with acquire, so that no byte is ever touched by two threads at once.
// Each thread keeps what it last saw of the other's count, and looks again only where that leaves it nothing to do.
// Counts of 64 bits, which no run exhausts.
template <class Memory>
class BasicPort {
 public:
  /// Holds up to `capacity` values of `size` bytes; at least one.
  BasicPort(std::size_t capacity, std::size_t size)
      : slots_(at_least_one(capacity), size, 0), size_(size), capacity_(capacity) {}

  std::size_t capacity() const { return capacity_; }
  /// Bytes of a value.
  std::size_t size() const { return size_; }

  /// Writer: copies the value; false, and nothing is written, if the port is full.
  bool write(const void* from) {
    return write_with([&](auto cell) { cell.put(0, from, size_); });
  }

  /// Reader: takes the oldest value; false, and `to` stays as it is, if there is none.
  bool read(void* to) {
    return read_with([&](auto cell) { cell.get(0, to, size_); });
  }

  /// A value inside its slot, in parts.
  struct Cell {
    std::byte* bytes;
    void put(std::size_t offset, const void* from, std::size_t count) { Memory::copy_in(bytes + offset, from, count); }
    void get(std::size_t offset, void* to, std::size_t count) { Memory::copy_out(to, bytes + offset, count); }
  };

  template <class Put>
  bool write_with(Put put) {
    Writer& w = writer_;
    if (w.written - w.taken == capacity_) {
      w.taken = taken_.load(std::memory_order_acquire);
      if (w.written - w.taken == capacity_) return false;
    }
    put(Cell{slots_.bytes(w.slot)});
    ++w.written;
    written_.store(w.written, std::memory_order_release);
    w.slot = slots_.after(w.slot);
    return true;
  }

  template <class Get>
  bool read_with(Get get) {
    Reader& r = reader_;
    if (r.taken == r.written) {
      r.written = written_.load(std::memory_order_acquire);
      if (r.taken == r.written) return false;
    }
    get(Cell{slots_.bytes(r.slot)});
    ++r.taken;
    taken_.store(r.taken, std::memory_order_release);
    r.slot = slots_.after(r.slot);
    return true;
  }

 private:
  struct Writer {
    std::uint64_t written = 0;
    std::uint64_t taken = 0;  // at least so many
    std::size_t slot = 0;
  };
  struct Reader {
    std::uint64_t taken = 0;
    std::uint64_t written = 0;  // at least so many
    std::size_t slot = 0;
  };

  static std::size_t at_least_one(std::size_t capacity) {
    if (capacity == 0) throw std::invalid_argument("a port holds at least one value");
    return capacity;
  }

  Slots<Memory> slots_;
  std::size_t size_;
  std::size_t capacity_;
  alignas(apart) Writer writer_;
  alignas(apart) typename Memory::template Atomic<std::uint64_t> written_{0};
  alignas(apart) Reader reader_;
  alignas(apart) typename Memory::template Atomic<std::uint64_t> taken_{0};
};

/// For flat values of a size that is known at construction.
using BytesPort = BasicPort<Memory>;
/// For flat values of one type.
template <class T>
using Port = ValuesPort<T, BasicPort<Memory>>;
/// For packets of up to so many bytes.
using PacketPort = PacketsPort<BasicPort<Memory>>;

}  // namespace jarol
