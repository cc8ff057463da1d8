// Values as CDR, the bytes that ROS 2 gives to messages of the schema that ros2msg.h makes of their type:
// little-endian, each number at a multiple of its size, a sequence or string after its length.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "graph/values/type.h"

namespace jarol {

/// Writes values of one type.
class CdrEncoder {
 public:
  explicit CdrEncoder(const Type& type);

  std::size_t size(const void* value) const { return flat_size_ > 0 ? flat_size_ : deep_size(value); }
  /// As many bytes as `size` says.
  void encode(const void* value, std::byte* to) const {
    std::memcpy(to, head, head_size);
    const auto* const from = static_cast<const std::byte*>(value);
    is_one_piece_ ? copy_short(to + head_size, from, flat_size_ - head_size) : encode_pieces(from, to);
  }

  /// Before each message: plain CDR, little-endian, no options.
  static constexpr std::size_t head_size = 4;
  static constexpr std::byte head[head_size]{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};

 private:
  std::size_t deep_size(const void* value) const;
  void encode_pieces(const std::byte* value, std::byte* to) const;

  // A call would take longer than so few bytes do.
  static void copy_short(std::byte* to, const std::byte* from, std::size_t bytes) {
    constexpr std::size_t step = 16, max = 256;
    if (bytes < step || bytes > max) {
      std::memcpy(to, from, bytes);
      return;
    }
    for (std::size_t at = 0; at < bytes - step; at += step) std::memcpy(to + at, from + at, step);
    std::memcpy(to + bytes - step, from + bytes - step, step);  // again some of those before it
  }

  struct Piece {
    std::size_t from = 0, to = 0, bytes = 0;
  };
  const Type* type_;
  std::size_t flat_size_ = 0;  // 0: it depends on the value
  bool has_gaps_ = false;
  bool is_one_piece_ = false;  // a flat value as it lies in memory
  std::vector<Piece> pieces_;  // of a flat value
};

/// Reads a value from bytes that come from outside; returns what is wrong with them, as in "ends before its bytes do",
/// or nothing. A value that something is wrong with is left as it was.
std::string decode_cdr(const Type& type, std::span<const std::byte> bytes, void* value);

}  // namespace jarol
