#include "graph/text/escape.h"

#include <algorithm>
#include <array>

namespace jarol {
namespace {

struct Range {
  char32_t first, last;
};

// what a terminal or an editor obeys instead of showing it, and what can't be seen (Unicode 15, UAX 9 and UTR 36)
constexpr std::array obeyed{
    Range{0x00, 0x1f},     Range{0x7f, 0x9f},     Range{0x061c, 0x061c},   Range{0x200b, 0x200b},
    Range{0x200e, 0x200f}, Range{0x2028, 0x202e}, Range{0x2060, 0x206f},   Range{0xfeff, 0xfeff},
    Range{0xfff9, 0xfffb}, Range{0xfffe, 0xffff}, Range{0xe0000, 0xe007f},
};

bool is_printable(char32_t code) {
  return std::none_of(obeyed.begin(), obeyed.end(), [&](Range r) { return code >= r.first && code <= r.last; });
}

void append_hex(std::string& to, char32_t code, int digits) {
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) to += "0123456789abcdef"[(code >> shift) & 0xf];
}

void append_escape(std::string& to, const Character& c) {
  if (c.code == '\n') {
    to += "\\n";
  } else if (c.code == '\t') {
    to += "\\t";
  } else if (c.code == '\r') {
    to += "\\r";
  } else if (!c.utf8 || c.code < 0x80) {
    append_hex(to += "\\x", c.code, 2);
  } else if (c.code < 0x10000) {
    append_hex(to += "\\u", c.code, 4);
  } else {
    append_hex(to += "\\U", c.code, 8);
  }
}

// Appends what may be shown, the rest as escapes; `keeps` are characters that stay nevertheless.
std::string escaped(std::string_view text, std::string_view keeps) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const Character c = first_character(text);
    if (c.printable || (c.size == 1 && keeps.find(text[0]) != std::string_view::npos))
      result += text.substr(0, c.size);
    else
      append_escape(result, c);
    text.remove_prefix(c.size);
  }
  return result;
}

std::string replaced(std::string_view text, std::string_view (*by)(char)) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    const std::string_view instead = by(c);
    if (instead.empty())
      result += c;
    else
      result += instead;
  }
  return result;
}

// Instead of a character that would be read as markup, in double quotes too; else nothing.
std::string_view xml_character(char c) {
  switch (c) {
    case '&': return "&amp;";
    case '<': return "&lt;";
    case '>': return "&gt;";
    case '"': return "&quot;";
    default: return "";
  }
}

}  // namespace

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {1, first, true, is_printable(first)};
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  const Character broken{1, first, false, false};
  if (first < 0xc2 || first > 0xf4 || text.size() < size) return broken;
  char32_t code = first & (0x7fU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return broken;
    code = (code << 6) | (byte(i) & 0x3fU);
  }
  // written longer than need be, one half of a pair of UTF-16, or beyond Unicode
  const char32_t min = size == 4 ? 0x10000 : size == 3 ? 0x800 : 0x80;
  if (code < min || (code >= 0xd800 && code <= 0xdfff) || code > 0x10ffff) return broken;
  return {size, code, true, is_printable(code)};
}

std::string printable(std::string_view text) { return escaped(text, ""); }

std::string printable_lines(std::string_view text) { return escaped(text, "\n\t"); }

std::string xml_text(std::string_view text) {
  return replaced(printable(text), [](char c) -> std::string_view { return c == '\'' ? "&#39;" : xml_character(c); });
}

std::string xml_attribute(std::string_view text) { return replaced(printable(text), xml_character); }

std::string dot_text(std::string_view text) {
  return replaced(printable(text), [](char c) -> std::string_view {
    return c == '"' ? "\\\"" : c == '\\' ? "\\\\" : "";
  });
}

std::string csv_text(std::string_view text) {
  const std::string shown = printable_lines(text);
  if (shown.find_first_of(",\"\n") == std::string::npos) return shown;
  return '"' + replaced(shown, [](char c) -> std::string_view { return c == '"' ? "\"\"" : ""; }) + '"';
}

}  // namespace jarol
