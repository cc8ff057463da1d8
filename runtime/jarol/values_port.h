// Ports, plain or push, for values of one type and for packets of any length.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace jarol {

/// For flat values of one type; what is written is copied.
template <class T, class Port>
class ValuesPort : public Port {
  static_assert(std::is_trivially_copyable_v<T>, "a port copies bytes; deep values cross as packets, see pack.h");

 public:
  explicit ValuesPort(std::size_t capacity) : Port(capacity, sizeof(T)) {}

  bool write(const T& value) {
    return this->write_with([&](auto cell) { cell.put(0, &value, sizeof(T)); });
  }
  bool read(T& value) {
    return this->read_with([&](auto cell) { cell.get(0, &value, sizeof(T)); });
  }
};

/// For packets of up to `longest` bytes.
template <class Port>
class PacketsPort {
 public:
  PacketsPort(std::size_t capacity, std::size_t longest)
      : port_(capacity, sizeof(std::uint64_t) + longest), longest_(longest) {}

  std::size_t capacity() const { return port_.capacity(); }
  std::size_t longest() const { return longest_; }

  /// Writer: false if the port refuses. Throws std::length_error for a packet that is too long for the port.
  bool write(std::span<const std::byte> packet) {
    if (packet.size() > longest_)
      throw std::length_error("a packet of " + std::to_string(packet.size()) +
                              " bytes does not fit into a port for at most " + std::to_string(longest_));
    return port_.write_with([&](auto cell) {
      const std::uint64_t length = packet.size();
      cell.put(0, &length, sizeof(length));
      cell.put(sizeof(length), packet.data(), packet.size());
    });
  }

  /// Reader: the length of the oldest packet, which is at the beginning of `room` then, or nothing. Throws
  /// std::length_error if the room is smaller than the longest packet.
  std::optional<std::size_t> read(std::span<std::byte> room) {
    if (room.size() < longest_)
      throw std::length_error("a room of " + std::to_string(room.size()) + " bytes is too small for packets of up to " +
                              std::to_string(longest_));
    std::uint64_t length = 0;
    // every length that was ever stored in a slot is within bounds, even if it is not the one of these bytes
    const bool found = port_.read_with([&](auto cell) {
      cell.get(0, &length, sizeof(length));
      cell.get(sizeof(length), room.data(), length);
    });
    if (!found) return std::nullopt;
    return length;
  }

  /// Reader: packets that were overwritten before they were read; push ports only.
  std::uint64_t lost() const requires requires(const Port& p) { p.lost(); }
  { return port_.lost(); }

 private:
  Port port_;
  std::size_t longest_;
};

}  // namespace jarol
