#include "tools/report/printable_stream.h"

#include <algorithm>

#include "graph/text/escape.h"

namespace jarol::tools {
namespace {

// Of the end of a text: the bytes that begin a character and lack the rest of it.
std::size_t begun_at_end(std::string_view text) {
  for (std::size_t back = 1; back <= std::min<std::size_t>(3, text.size()); ++back) {
    const auto byte = static_cast<unsigned char>(text[text.size() - back]);
    if ((byte & 0xc0) == 0x80) continue;
    const std::size_t size = byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : byte >= 0xc2 ? 2 : 1;
    return size > back ? back : 0;
  }
  return 0;
}

}  // namespace

PrintableStream::~PrintableStream() {
  put(begun_);
  stream_.rdbuf(to_);
}

bool PrintableStream::put(std::string_view text) {
  const std::string shown = printable_lines(text);
  const auto size = static_cast<std::streamsize>(shown.size());
  return to_->sputn(shown.data(), size) == size;
}

std::streamsize PrintableStream::xsputn(const char* text, std::streamsize size) {
  begun_.append(text, static_cast<std::size_t>(size));
  const std::size_t whole = begun_.size() - begun_at_end(begun_);
  const bool written = put(std::string_view(begun_).substr(0, whole));
  begun_.erase(0, whole);
  return written ? size : 0;
}

PrintableStream::int_type PrintableStream::overflow(int_type character) {
  if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
  const char one = traits_type::to_char_type(character);
  return xsputn(&one, 1) == 1 ? character : traits_type::eof();
}

}  // namespace jarol::tools
