// Appends to a file in few calls of the system.
#pragma once

#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <string_view>

namespace jarol {

class Appender {
 public:
  /// The file stays the caller's, who writes nothing to it but by this.
  explicit Appender(std::FILE* file);

  /// The system has all of it when this returns. Throws std::system_error where it can't be written.
  void append(std::initializer_list<std::string_view> pieces);

  /// Gives back what was allocated ahead: a long regular file gets its place on the disk in large steps, beyond its
  /// end, which saves the system a third of its work. What a killed program leaves there is no part of the file.
  void end();

  /// Appended so far.
  std::uint64_t bytes() const { return bytes_; }

 private:
  void allocate_ahead();

  std::FILE* file_;
  int descriptor_ = -1;  // of a regular file
  std::uint64_t bytes_ = 0;
  std::uint64_t allocated_ = 0;  // so many have a place on the disk
};

}  // namespace jarol
