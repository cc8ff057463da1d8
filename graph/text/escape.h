// What comes from outside (names, paths, texts of exceptions), as it may be shown: the one place that says how.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace jarol {

/// The first character of a text that is not empty.
struct Character {
  std::size_t size = 1;  // bytes
  char32_t code = 0;     // of a byte that begins no UTF-8: the byte
  bool utf8 = false;
  /// No control character (C0, C1, DEL), no separator of lines, nothing that turns the direction of text or is
  /// invisible.
  bool printable = false;
};
Character first_character(std::string_view text);

/// One line in UTF-8 that a terminal shows and does not obey: what is not printable becomes \n, \t, \r, \x1b or \u202e.
/// A backslash stays one: the text is for people, it is not read back.
std::string printable(std::string_view text);

/// The same of a text of several lines: line ends and tabs stay.
std::string printable_lines(std::string_view text);

/// Printable, and as it stands between the tags or in the quotes of an attribute of XML.
std::string xml_text(std::string_view text);

/// Printable, and as it stands in the double quotes of an attribute of XML, where a list of fonts has single ones.
std::string xml_attribute(std::string_view text);

/// Printable, and as it stands in the quotes of a word of DOT.
std::string dot_text(std::string_view text);

/// A field of a CSV row: printable, but for line ends and tabs, and in quotes where it has to be.
std::string csv_text(std::string_view text);

}  // namespace jarol
