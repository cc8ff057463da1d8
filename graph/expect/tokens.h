// The words of a condition, each with its place in the text.
#pragma once

#include <string_view>
#include <vector>

namespace jarol::expect {

struct Token {
  enum class Kind { word, number, sign, end } kind = Kind::end;
  std::string_view text;   // of a number with its unit
  std::size_t column = 0;  // in the text, from 0
};

/// Words keep their dots; the last token is the end. A character that belongs nowhere is a sign of its own.
std::vector<Token> tokens_of(std::string_view text);

/// A word of the language itself.
bool is_keyword(std::string_view word);

}  // namespace jarol::expect
