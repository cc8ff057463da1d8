// Values as CDR, the bytes that ROS 2 gives to messages of the schema that ros2msg.h makes of their type:
// little-endian, each number at a multiple of its size, a sequence or string after its length.
#pragma once

#include <cstddef>
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
  void encode(const void* value, std::byte* to) const;

 private:
  std::size_t deep_size(const void* value) const;

  struct Piece {
    std::size_t from = 0, to = 0, bytes = 0;
  };
  const Type* type_;
  std::size_t flat_size_ = 0;  // 0: it depends on the value
  bool has_gaps_ = false;
  std::vector<Piece> pieces_;  // of a flat value
};

/// Reads a value from bytes that come from outside; returns what is wrong with them, as in "ends before its bytes do",
/// or nothing. A value that something is wrong with is left as it was.
std::string decode_cdr(const Type& type, std::span<const std::byte> bytes, void* value);

}  // namespace jarol
