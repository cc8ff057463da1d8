// Appends to a file in few calls of the system.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string_view>

namespace jarol {

class Appender {
 public:
  /// The file is empty and stays the caller's, who writes nothing to it but by this.
  explicit Appender(std::FILE* file);

  /// One after another; the system has all of it when this returns. Throws std::system_error where it can't be written.
  void append(std::string_view first, std::string_view second = {}, std::string_view third = {});

  /// Gives back what was allocated ahead: a long regular file gets its place on the disk in large steps, beyond its
  /// end, which saves the system a third of its work. What a program that is killed or fails leaves there is no part of
  /// the file.
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
