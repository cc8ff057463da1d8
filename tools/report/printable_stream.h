// A stream that shows what a terminal would obey: the last of all that the command prints.
#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace jarol::tools {

/// While it lives, what is written to the stream goes through printable_lines. Own sequences, as of a progress line,
/// go to stderr by other ways.
class PrintableStream : private std::streambuf {
 public:
  explicit PrintableStream(std::ostream& stream) : stream_(stream), to_(stream.rdbuf(this)) {}
  ~PrintableStream() override;
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int sync() override { return to_->pubsync(); }
  bool put(std::string_view text);

  std::ostream& stream_;
  std::streambuf* to_;
  std::string begun_;  // a character of which more is to come
};

}  // namespace jarol::tools
