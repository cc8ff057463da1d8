// A text as yaml-cpp reads it: piece by piece, with a limit to what it may scan ahead of what it has understood.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <streambuf>
#include <string_view>

namespace jarol {

/// What yaml-cpp may scan before it has understood what it began with.
inline constexpr std::size_t max_bytes_ahead = std::size_t{2} << 20;
inline constexpr std::size_t max_marks_ahead = 250'000;

/// A text that is no YAML of a reasonable size.
struct TooMuch {
  bool ahead = false;
};

/// Gives yaml-cpp the text in pieces. What it has scanned and not understood yet, it keeps, in 250 bytes a mark; and a
/// bracket that is never closed makes it scan on to the end.
class TextPieces : public std::streambuf {
 public:
  explicit TextPieces(std::string_view text) : text_(text.data()), end_(const_cast<char*>(text.data() + text.size())) {
    char* const begin = const_cast<char*>(text.data());  // a streambuf that is only read does not write
    setg(begin, begin, begin);
  }

  void understood() { bytes_ = marks_ = 0; }

  /// Bytes so far.
  std::size_t read() const { return static_cast<std::size_t>(egptr() - text_); }

 protected:
  int_type underflow() override {
    constexpr std::ptrdiff_t piece = 4096;
    if (gptr() == end_) return traits_type::eof();
    const std::ptrdiff_t size = std::min(piece, end_ - gptr());
    bytes_ += static_cast<std::size_t>(size);
    for (const char c : std::string_view(gptr(), static_cast<std::size_t>(size)))
      marks_ += is_mark[static_cast<unsigned char>(c)] ? 1 : 0;
    if (bytes_ > max_bytes_ahead || marks_ > max_marks_ahead) throw TooMuch{true};
    setg(eback(), gptr(), gptr() + size);
    return traits_type::to_int_type(*gptr());
  }

 private:
  static constexpr auto is_mark = [] {
    std::array<bool, 256> marks{};
    for (const char c : std::string_view("[]{},:'\"&*!?-|>%")) marks[static_cast<unsigned char>(c)] = true;
    return marks;
  }();

  const char* text_;
  char* end_;
  std::size_t bytes_ = 0, marks_ = 0;  // since something was understood; the marks are what YAML is made of
};

}  // namespace jarol
